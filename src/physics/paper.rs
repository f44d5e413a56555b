//! The source paper's method, as printed.
