//! JSON with one line for each record.

use std::io::{self, Write};

use planar_impact_app::check::{Entry, Summary};
use planar_impact_app::json::escaped;
use serde::Serialize;

use super::Report;

/// A report in JSON.
#[derive(Default)]
pub struct Json {
    is_behind: bool,
}

/// Writes plain data as JSON.
///
/// # Errors
///
/// No known error, because it writes to memory.
pub fn write(to: &mut Vec<u8>, data: &impl Serialize) -> io::Result<()> {
    to.write_all(escaped(&serde_json::to_string(data)?).as_bytes())
}

impl Report for Json {
    fn begin(&mut self, to: &mut Vec<u8>) -> io::Result<()> {
        write!(to, "{{ \"schema\": 1, \"records\": [")
    }

    fn begin_file(&mut self, _: &mut Vec<u8>, _: &str) -> io::Result<()> {
        Ok(())
    }

    fn record(&mut self, to: &mut Vec<u8>, file: &str, entry: &Entry) -> io::Result<()> {
        writeln!(to, "{}", if self.is_behind { "," } else { "" })?;
        self.is_behind = true;
        write(to, &entry.in_json(file))
    }

    fn end_file(&mut self, _: &mut Vec<u8>) -> io::Result<()> {
        Ok(())
    }

    fn end(&mut self, to: &mut Vec<u8>, summary: &Summary, interrupted: bool) -> io::Result<()> {
        write!(to, "\n],\n{}\"summary\": ", if interrupted { "\"interrupted\": true,\n" } else { "" })?;
        write(to, summary)?;
        writeln!(to, " }}")
    }
}
