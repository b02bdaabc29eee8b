//! From evidence back to what it is evidence of.

mod answers;
mod calibration;
mod closed_form;
mod diagnosis;
mod scene;
mod table;
mod verdicts;
