//! Whether the uncertainty is right.
