//! The scan: how a controller solves a program.
