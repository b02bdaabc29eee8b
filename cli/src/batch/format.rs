//! The format of a table, told by the name of its file.

use std::path::Path;

use planar_impact_app::quantity::excerpt;
use planar_impact_app::{Issue, Issues};

/// The format of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Comma-separated values with a header.
    Csv,
    /// Apache Parquet.
    Parquet,
    /// Arrow's file format for communication between processes, also called Feather.
    Arrow,
}

impl Format {
    /// Returns the format of a file, or of CSV for `-`.
    ///
    /// # Errors
    ///
    /// If the name ends in none that is known.
    pub fn of(path: &Path) -> Result<Format, Issues> {
        if path.as_os_str() == "-" {
            return Ok(Format::Csv);
        }
        let extension = path.extension().and_then(|end| end.to_str()).map(str::to_ascii_lowercase);
        match extension.as_deref() {
            Some("csv") => Ok(Format::Csv),
            Some("parquet") => Ok(Format::Parquet),
            Some("arrow" | "feather" | "ipc") => Ok(Format::Arrow),
            _ => {
                let message = format!(
                    "{} is not the name of a table; it must end in .csv, .parquet, .arrow, .feather or .ipc",
                    excerpt(&path.display().to_string())
                );
                let help = "`-` is CSV on standard input or output";
                Err(Issues::of_call(vec![Issue::of_file("unreadable-file", message).with_help(help)]))
            }
        }
    }
}
