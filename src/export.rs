//! Rows → CSV or JSON lines, to any writer.
