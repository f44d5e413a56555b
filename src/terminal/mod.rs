//! Drives the application on a real terminal. The only place that names crossterm.
