"""The same words, fewer bytes: a read-only half-edge mesh of 4.6 bits per edge, its directories included."""
