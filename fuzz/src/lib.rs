//! Fuzz targets: from bytes to an input of every form that a person or a program gives, through the same functions as every interface, to oracles that do not know
//! the code. An accepted answer is recomputed in exact rational arithmetic; forms of the same input give the same answer; what is written is what is read.
//!
//! `.ci/fuzz SECONDS` runs each target with libFuzzer; `cargo test` here replays the corpus and plants errors that each oracle must notice.

pub mod bytes;
pub mod cases;
pub mod edits;
pub mod formulas;
pub mod oracle;
pub mod quantities;
pub mod recordings;
pub mod records;
pub mod tables;

#[path = "../../cli/src/defect.rs"]
mod defect;
#[path = "../../cli/src/files.rs"]
#[allow(dead_code)]
mod files;
#[allow(dead_code)]
mod table_files;

/// A target: a function of bytes that panics if a law does not hold.
pub type Target = fn(&[u8]);

/// Every target by name.
pub const TARGETS: [(&str, Target); 10] = [
    ("case", cases::structured),
    ("case_text", cases::text),
    ("edit", edits::run),
    ("formula", formulas::run),
    ("quantity", quantities::run),
    ("record", records::structured),
    ("record_text", records::text),
    ("recording", recordings::run),
    ("table", tables::structured),
    ("table_bytes", tables::bytes),
];

/// Returns the target with a name.
pub fn target(name: &str) -> Option<Target> {
    TARGETS.iter().find(|(known, _)| *known == name).map(|(_, target)| *target)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every input of the corpus, under the name of its target, and bytes of a small generator.
    #[test]
    fn the_corpus_holds() {
        let corpus = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
        for (name, target) in TARGETS {
            let mut inputs = 0;
            for entry in std::fs::read_dir(corpus.join(name)).unwrap_or_else(|error| panic!("{name} has no corpus: {error}")) {
                target(&std::fs::read(entry.expect("an entry").path()).expect("a file"));
                inputs += 1;
            }
            assert!(inputs > 0, "{name} has no corpus");
        }
    }
}
