# Empty dependencies file for tact.
# This may be replaced when dependencies are built.
