# Empty dependencies file for tact_python.
# This may be replaced when dependencies are built.
