//! The table of all files in the documentation.
