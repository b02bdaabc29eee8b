//! Reconstruction of collisions from evidence.

mod answers;
mod calibration;
mod closed_form;
mod coverage;
mod dependence;
mod diagnosis;
mod guaranteed;
mod intervals;
mod posterior;
mod ratio;
mod scene;
mod table;
mod verdicts;
