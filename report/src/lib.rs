//! Renders answers of planar-impact as pages.
//!
//! A page is a list of [blocks](Block), made from one answer in a system of units: `page::page(&answer, units)`. [`text::render`] prints it on a
//! terminal, [`html::render`] a [`document`] in a browser, and [`scene::scene`] draws a collision. A page computes nothing but units and digits; every fact stands in the answer.
// Tests compute with the functions of the platform, so that they do not repeat the program.
#![cfg_attr(test, allow(clippy::disallowed_methods))]

pub mod block;
pub mod chart;
pub mod document;
pub mod html;
pub mod page;
pub mod scene;
pub mod svg;
pub mod text;

pub use block::{Align, Block, Table};
