//! From evidence back to what it is evidence of.

mod calibration;
mod scene;
mod table;
