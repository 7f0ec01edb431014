"""Bodies over the ranks of an MPI communicator: `mpirun -n 4 python3 program.py`.

Needs mpi4py, and tact built where MPI and Zoltan are.
"""

from mpi4py import MPI as _MPI  # noqa: F401  initialises MPI, and ends it after the last world

from ._tact_mpi import *  # noqa: F403
