# Empty compiler generated dependencies file for tact_broadphase.
# This may be replaced when dependencies are built.
