//! The running application without a terminal: keys in, buffer out.
