//! Planar impacts in [Arrow](https://arrow.apache.org): record batches of collisions in, record batches with their outputs out.
//!
//! A column is an input if it has the name of one, such as `vehicle.1.speed`, with its unit in brackets (`vehicle.1.speed [mph]`) or in the metadata of its
//! field under `unit`; without a unit it is in SI and radians. Every other column passes through. What no column has, and an empty cell, is that of a case file.
//!
//! ```
//! use std::sync::Arc;
//! use arrow_array::{Float64Array, RecordBatch, cast::AsArray, types::Float64Type};
//! use planar_impact_app::{Case, Source, batch::Options};
//! use planar_impact_arrow::Plan;
//!
//! let case = r#"
//!     schema = 1
//!     [[vehicle]]
//!     mass = 1500
//!     yaw_inertia = 2500
//!     heading = 0
//!     speed = 15
//!     impact_center = [2, 0]
//!     [[vehicle]]
//!     barrier = true
//!     [contact]
//!     crush_plane = 0
//!     restitution = 0.1
//! "#;
//! let case = Case::parse(Source::new("barrier.toml", case))?;
//! let speeds = Float64Array::from(vec![Some(54.0), None, Some(-3.6)]);
//! let table = RecordBatch::try_from_iter([("vehicle.1.speed [km/h]", Arc::new(speeds) as _)])?;
//!
//! let options = Options { of: vec!["energy.loss".to_owned()], ..Options::default() };
//! let plan = Plan::of(table.schema_ref(), Some(&case), &options)?;
//! let answer = plan.solve(&table)?;
//! let loss = answer["energy.loss"].as_primitive::<Float64Type>();
//! // The second row takes the speed of the case, 15 m/s = 54 km/h; the third vehicle moves away.
//! assert_eq!(loss.value(0), loss.value(1));
//! assert_eq!(answer["refusal"].as_string::<i32>().value(2), "separating");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod answer;
mod cells;
mod plan;

pub use plan::{Plan, Solved, unit_of};
pub use planar_impact_app::batch::{Options, Refused};

#[cfg(test)]
mod tests;
