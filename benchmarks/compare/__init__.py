"""One file per library, each with the same small interface, so that a task can be put to all of them."""
