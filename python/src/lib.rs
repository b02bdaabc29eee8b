//! The Python module `planar_impact._native`: case files, verbs, tables.
//!
//! It reads arguments, calls the application layer without the interpreter lock, and turns issues into exceptions. The package
//! `planar_impact` beside it has the public functions.

mod answer;
mod batch;
mod control;
mod error;
mod plain;
mod source;
mod table;
mod units;
mod verbs;

use pyo3::prelude::*;

/// Case files, verbs and tables of planar-impact.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::answer::Answer;
    #[pymodule_export]
    use crate::batch::Plan;
    #[pymodule_export]
    use crate::source::Source;
    #[pymodule_export]
    use crate::table::{Table, solve_stream, solve_table};
    #[pymodule_export]
    use crate::verbs::{
        check, crash3, crush, draw, formula, gradient, reconstruct, record, report, slide, solve, stiffness, sweep, template, uncertainty,
    };

    #[pymodule_export]
    #[allow(non_upper_case_globals)]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
