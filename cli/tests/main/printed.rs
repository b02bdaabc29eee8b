//! What the program prints of the examples, byte by byte: pages, drawings, charts and reports that were read and looked at. Whatever changes a number, a word or a line
//! of them is noticed here.
//!
//! After a change that is meant, look at what `target/tmp/printed` has, beside the same of the commit before, and run the tests with `UPDATE_PRINTED=1`.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use crate::process::run;

/// The file of the bytes and the hash of each output, a line for each command.
fn reference() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/printed.txt")
}

/// The hash of Fowler, Noll and Vo (FNV-1a, 64 bits).
fn hash(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

fn known() -> BTreeMap<String, String> {
    let text = fs::read_to_string(reference()).unwrap_or_default();
    text.lines().filter_map(|line| line.split_once('\t')).map(|(call, print)| (call.to_owned(), print.to_owned())).collect()
}

fn print_the_same(calls: &[&str]) {
    static FILE: Mutex<()> = Mutex::new(());
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let kept = Path::new(env!("CARGO_TARGET_TMPDIR")).join("printed");
    fs::create_dir_all(&kept).expect("a folder");
    let mut printed = BTreeMap::new();
    for call in calls {
        let run = run(folder, &call.split(' ').collect::<Vec<_>>());
        assert!(run.status <= 1 && !run.out.is_empty(), "{call}: {}", run.err);
        // The version is that of the package, and is no change.
        let out = run.out.replace(concat!("planar-impact ", env!("CARGO_PKG_VERSION")), "planar-impact VERSION");
        fs::write(kept.join(call.replace(['/', ' '], "_")), &run.out).expect("written");
        printed.insert((*call).to_owned(), format!("{} bytes, {:016x}", out.len(), hash(&out)));
    }
    let guard = FILE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let mut known = known();
    if std::env::var_os("UPDATE_PRINTED").is_some() {
        known.extend(printed);
        let lines: String = known.iter().map(|(call, print)| format!("{call}\t{print}\n")).collect();
        fs::write(reference(), lines).expect("written");
        return;
    }
    drop(guard);
    let changed: Vec<&String> = printed.iter().filter(|(call, print)| known.get(*call) != Some(*print)).map(|(call, _)| call).collect();
    assert!(changed.is_empty(), "other output than before, which {} has: {changed:#?}", kept.display());
}

macro_rules! prints {
    ($($test:ident: $($call:literal),+;)+) => {
        $(
            #[test]
            fn $test() {
                print_the_same(&[$($call),+]);
            }
        )+

        /// No line of the reference is left over.
        #[test]
        fn each_reference_has_its_call() {
            let all: Vec<&str> = [$(&[$($call),+][..]),+].concat();
            let left: Vec<String> = known().into_keys().filter(|call| !all.contains(&call.as_str())).collect();
            assert!(left.is_empty() && all.len() > 50, "{left:#?}");
        }
    };
}

prints! {
    solutions:
        "solve examples/position-a.toml",
        "solve examples/stiff-corner.toml --units us",
        "solve examples/cavalier-crush.toml --units uk",
        "gradient examples/oblique-surfaces.toml",
        "gradient examples/position-a.toml --of dV1,W_n --wrt Gamma,e,m1 --second",
        "sweep examples/position-a.toml --vary e=0:0.5:0.1",
        "compare examples/position-a.toml examples/position-c.toml examples/reconstruct/position-a.toml",
        "formula mu0 --wrt e",
        "formula T_L --ratio friction --format rust";
    records:
        "check examples/check/engine.jsonl",
        "check examples/check/paper-table-2.csv",
        "record examples/record/barrier.toml",
        "record examples/record/edr.csv",
        "record examples/record/barrier.toml --format svg",
        "record examples/record/edr.csv --format svg",
        "report examples/check/engine.jsonl --verb check";
    crush:
        "crush examples/cavalier-crush.toml",
        "crash3 examples/cavalier-crush.toml",
        "stiffness examples/tests/malibu.toml",
        "stiffness examples/tests/struble-welsh.toml",
        "report examples/cavalier-crush.toml --verb crush",
        "report examples/cavalier-crush.toml --verb crash3",
        "report examples/tests/malibu.toml --verb stiffness",
        "report examples/tests/struble-welsh.toml --verb stiffness";
    tables_of_the_paper:
        "validate",
        "validate --figure 6",
        "validate --figure 7",
        "report --verb validate";
    reconstructions:
        "reconstruct examples/reconstruct/crabbed-1.toml",
        "reconstruct examples/reconstruct/from-tests.toml",
        "reconstruct examples/reconstruct/head-on-offset.toml --units si",
        "reconstruct examples/reconstruct/momentum.toml",
        "reconstruct examples/reconstruct/rear-end.toml",
        "reconstruct examples/reconstruct/single-vehicle-barrier.toml --units us",
        "reconstruct examples/reconstruct/uncertain-masses.toml",
        "report examples/reconstruct/rear-end.toml --units uk";
    a_profile:
        "reconstruct examples/reconstruct/t-bone.toml --profile";
    several_separations:
        "report examples/reconstruct/several-separations.toml";
    two_cars:
        "report examples/reconstruct/two-cars.toml --date today";
    a_recorder:
        "reconstruct examples/reconstruct/recorder.toml";
    uncertainties:
        "uncertainty examples/uncertain.toml --samples 500";
    a_chart_of_uncertainty:
        "uncertainty examples/uncertain.toml --samples 500 --format svg";
    correlated_uncertainty:
        "uncertainty examples/uncertainty/correlated.toml --samples 500 --method shapley";
    a_report_of_uncertainty:
        "report examples/uncertain.toml --verb uncertainty";
    slides:
        "slide examples/slide.toml",
        "draw examples/to-rest.toml";
    drawings:
        "draw examples/cavalier-crush.toml",
        "draw examples/crabbed-barrier.toml",
        "draw examples/oblique-surfaces.toml",
        "draw examples/position-a.toml",
        "draw examples/sideswipe.toml --units uk",
        "draw examples/stiff-corner.toml",
        "draw examples/reconstruct/momentum.toml";
    charts:
        "sweep examples/position-a.toml --vary e=0.1:0.1:0.1 --vary Gamma=-60deg:60deg:10deg --format svg",
        "sweep examples/sideswipe.toml --vary e=0:1:0.1 --vary Gamma=-90deg:90deg:10deg --format svg",
        "sweep examples/position-a.toml --vary e=0:0.5:0.1 --format svg",
        "sweep examples/position-a.toml --vary e=0:1:0.1 --vary Gamma=-60deg:60deg:10deg --format svg",
        "compare examples/position-a.toml examples/position-c.toml examples/reconstruct/position-a.toml --format svg";
    reports:
        "report examples/position-a.toml",
        "report examples/sideswipe.toml",
        "report examples/stiff-corner.toml --units si";
}
