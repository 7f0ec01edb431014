file(REMOVE_RECURSE
  "libtact.a"
)
