# Empty dependencies file for tact_base.
# This may be replaced when dependencies are built.
