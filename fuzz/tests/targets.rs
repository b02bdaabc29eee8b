//! Each target on its corpus and, for `FUZZ_SECONDS`, on what becomes of it by chance; `FUZZ_SEED` sets other inputs. libFuzzer, which `.ci/fuzz` runs, is guided by
//! coverage; this needs no build of its own. A failure leaves its input in `fuzz/artifacts`.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::Path;
use std::time::{Duration, Instant};

use planar_impact_fuzz::{tables, target};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Inputs of the corpus that a new one is made of, and changes of it.
const MOST_CHANGES: usize = 8;

/// Longest input, as of libFuzzer.
const LONGEST: usize = 4096;

/// Makes an input of one of the corpus: a few bytes of it are replaced, removed or repeated, or a part of another one takes their place.
fn changed(corpus: &[Vec<u8>], random: &mut ChaCha8Rng) -> Vec<u8> {
    let mut bytes = corpus[random.random_range(0..corpus.len())].clone();
    for _ in 0..random.random_range(1..=MOST_CHANGES) {
        let at = random.random_range(0..=bytes.len());
        let end = (at + random.random_range(0..=16)).min(bytes.len());
        let part = match random.random_range(0..5) {
            0 => (at..end).map(|_| random.random()).collect(),
            1 => Vec::new(),
            2 => bytes[at..end].repeat(2),
            3 => vec![random.random(); random.random_range(1..=8)],
            _ => {
                let other = &corpus[random.random_range(0..corpus.len())];
                let from = random.random_range(0..=other.len());
                other[from..(from + random.random_range(0..=64)).min(other.len())].to_vec()
            }
        };
        bytes.splice(at..end, part);
    }
    bytes.truncate(LONGEST);
    bytes
}

fn run(name: &str) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let run = target(name).expect("a target");
    // Some readers of tables panic on damaged files, and the program makes an error of it.
    tables::install();
    let entries = std::fs::read_dir(folder.join("corpus").join(name)).expect("a corpus");
    let corpus: Vec<Vec<u8>> = entries.map(|entry| std::fs::read(entry.expect("an entry").path()).expect("a file")).collect();
    assert!(!corpus.is_empty(), "{name} has no corpus");
    let hold = |input: &[u8]| {
        if let Err(panic) = catch_unwind(AssertUnwindSafe(|| run(input))) {
            let artifacts = folder.join("artifacts").join(name);
            let kept = artifacts.join("failed");
            let written = std::fs::create_dir_all(&artifacts).and_then(|()| std::fs::write(&kept, input));
            eprintln!("{name}: the input that failed is {} ({written:?})", kept.display());
            resume_unwind(panic);
        }
    };
    corpus.iter().for_each(|input| hold(input));
    let seconds = std::env::var("FUZZ_SECONDS").ok().and_then(|seconds| seconds.parse().ok()).unwrap_or(1.0);
    // The same inputs in every run, as of the other tests.
    let seed = std::env::var("FUZZ_SEED").ok().and_then(|seed| seed.parse().ok()).unwrap_or(1);
    let (mut random, begin, mut executions) = (ChaCha8Rng::seed_from_u64(seed), Instant::now(), corpus.len());
    while begin.elapsed() < Duration::from_secs_f64(seconds) {
        hold(&changed(&corpus, &mut random));
        executions += 1;
    }
    println!("{name}: {executions} executions");
}

mod target {
    macro_rules! targets {
        ($($name:ident),*) => {
            /// Every target has a test.
            #[test]
            fn all() {
                assert!(planar_impact_fuzz::TARGETS.iter().map(|(name, _)| *name).eq([$(stringify!($name)),*]));
            }

            $(
                #[test]
                fn $name() {
                    super::run(stringify!($name));
                }
            )*
        };
    }

    targets!(case, case_text, edit, formula, quantity, record, record_text, recording, table, table_bytes);
}
