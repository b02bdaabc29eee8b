//! libFuzzer on the target that `FUZZ_TARGET` names. `.ci/fuzz` builds and runs it.
#![no_main]

use libfuzzer_sys::fuzz_target;
use planar_impact_fuzz::{Target, tables, target};

/// Returns the target of this run.
fn chosen() -> Target {
    static CHOSEN: std::sync::OnceLock<Target> = std::sync::OnceLock::new();
    *CHOSEN.get_or_init(|| {
        let name = std::env::var("FUZZ_TARGET").unwrap_or_default();
        target(&name).unwrap_or_else(|| panic!("FUZZ_TARGET is `{name}`, which is no target"))
    })
}

fuzz_target!(
    init: {
        // Some readers of tables panic on damaged files, and the program makes an error of it; any other panic ends the run.
        tables::install();
        chosen();
    },
    |data: &[u8]| chosen()(data)
);
