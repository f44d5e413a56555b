//! A run told in lines, one per event: for dumb terminals and screen readers.
