//! A finished buffer as bytes: terminal differences, text, ANSI, SVG.
