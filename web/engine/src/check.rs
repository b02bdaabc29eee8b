//! The verb `check`: records of any program, in a file that is dropped on the page.

use planar_impact_app::check::{CheckReport, Entries, Entry, Options, Origin, Summary};
use planar_impact_app::json::{self, Layout};
use planar_impact_app::{Issues, Units};
use planar_impact_report::document::{self, CheckDigest};
use planar_impact_report::html;
use wasm_bindgen::prelude::*;

use crate::reply::Reply;

/// Most records that the JSON of a page has; the counts are of all.
const MOST: usize = 100_000;

/// Checks the records of a file.
#[wasm_bindgen]
pub fn check(name: &str, bytes: Vec<u8>) -> Reply {
    run(name, bytes).unwrap_or_else(|issues| Reply::refusal(&issues, Units::Si))
}

fn run(name: &str, bytes: Vec<u8>) -> Result<Reply, Issues> {
    let extension = name.rsplit_once('.').map(|(_, extension)| extension.to_ascii_lowercase());
    let origin = Origin::Pipe(Box::new(std::io::Cursor::new(bytes)));
    let (mut digest, mut summary, mut kept) = (CheckDigest::default(), Summary::default(), Vec::<Entry>::new());
    digest.file(name);
    for entry in Entries::open(name, extension.as_deref(), origin, Options::default())? {
        let entry = entry?;
        summary.add(&entry);
        digest.add(name, &entry);
        if kept.len() < MOST {
            kept.push(entry);
        }
    }
    let records = kept.iter().map(|entry| entry.in_json(name)).collect();
    let report = CheckReport { schema: planar_impact_app::answer::SCHEMA, records, interrupted: false, summary };
    let sections = digest.document(&document::Options { units: Units::Si, date: None, parts: Vec::new() })?.sections;
    let blocks: Vec<_> = sections.into_iter().flat_map(|section| section.blocks).collect();
    Ok(Reply { json: json::text(&report, Layout::Pretty)?, html: html::fragment(&blocks), ..Reply::default() })
}
