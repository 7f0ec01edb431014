# Empty compiler generated dependencies file for tact_narrowphase.
# This may be replaced when dependencies are built.
