//! Writes the figures of `docs/testing.md` between its marks, from what is in the repository:
//!
//! ```sh
//! cargo run -p planar-impact-validation --bin testing-report
//! ```

use std::fs;
use std::io;
use std::path::Path;

const BEGIN: &str = "<!-- figures: written by testing-report -->";
const END: &str = "<!-- end of figures -->";

fn main() -> io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let page = root.join("docs/testing.md");
    let text = fs::read_to_string(&page)?;
    let (Some(begin), Some(end)) = (text.find(BEGIN), text.find(END)) else {
        return Err(io::Error::other("docs/testing.md has lost its marks"));
    };
    let figures = figures(&root)?;
    fs::write(&page, format!("{}{BEGIN}\n\n{figures}\n{}", &text[..begin], &text[end..]))
}

/// Returns the figures as a table.
fn figures(root: &Path) -> io::Result<String> {
    let read = |path: &str| fs::read_to_string(root.join(path));
    let mut tests = 0;
    let mut laws = 0;
    for folder in ["src", "app", "arrow", "report", "cli", "proofs", "validation", "proptests"] {
        count(&root.join(folder), &mut |text| {
            let found = text.lines().filter(|line| line.trim() == "#[test]").count();
            if folder == "proptests" { laws += found } else { tests += found }
        })?;
    }
    // Each table has a row of heads, above a line.
    let begins = |text: &str, with: &str| text.lines().filter(|line| line.starts_with(with)).count();
    let rows = |text: &str| begins(text, "| ") - begins(text, "|-");
    let reproducers = fs::read_dir(root.join("cli/tests/reproducers"))?.count();
    let executions = read("fuzz/executions.txt")?;
    let fuzzed: u64 = executions.lines().filter_map(|line| line.split_whitespace().nth(1)?.parse::<u64>().ok()).sum();
    let hashes = read(".ci/same_bits/hashes.txt")?;
    let all = hashes.lines().find_map(|line| line.strip_prefix("all")).unwrap_or_default().trim().to_owned();
    let crates = read("Cargo.lock")?.matches("[[package]]").count();
    let mut text = format!("Of version {}.\n\n| what | number |\n|---|---:|\n", env!("CARGO_PKG_VERSION"));
    let mut row = |what: &str, number: String| text.push_str(&format!("| {what} | {number} |\n"));
    row("rows of `docs/laws.md`, each law with how it is established", rows(&read("docs/laws.md")?).to_string());
    row("tests of functions, answers and the command line", tests.to_string());
    row("property tests of laws, 10⁴ cases each but for slow ones", laws.to_string());
    row("inputs that once failed, kept as tests of the command line", reproducers.to_string());
    row("executions of the fuzz targets in the last campaign", fuzzed.to_string());
    row("hash of 10⁵ collisions, their derivatives, a batch, a Monte Carlo mean and a reconstruction", format!("`{all}`"));
    row("packages of the main lock file", crates.to_string());
    text.push_str(
        "\nExecutions by target, with the edges of the program that were reached:\n\n| target | executions | edges |\n|---|---:|---:|\n",
    );
    for line in executions.lines() {
        if let [target, count, _, edges, ..] = line.split_whitespace().collect::<Vec<_>>()[..] {
            text.push_str(&format!("| `{target}` | {count} | {edges} |\n"));
        }
    }
    text.push_str("\nChanges of the program that were tried, by part; what does not compile is left out:\n\n| part | tried | noticed | survived |\n|---|---:|---:|---:|\n");
    let counts = read(".ci/mutants/counts.txt")?;
    let parts: Vec<(&str, [u64; 3])> = counts.lines().filter_map(changes).collect();
    let sum = parts.iter().fold([0; 3], |sum, (_, of)| std::array::from_fn(|i| sum[i] + of[i]));
    for (part, [noticed, timed_out, survived]) in parts.into_iter().chain([("all", sum)]) {
        let noticed = noticed + timed_out;
        text.push_str(&format!("| {part} | {} | {noticed} | {survived} |\n", noticed + survived));
    }
    Ok(text)
}

/// Returns a part of the program with how many of its changes were noticed, never ended, and survived, from a line such as
/// `src/check: 70 noticed, 1 timed out, 2 survived`.
fn changes(line: &str) -> Option<(&str, [u64; 3])> {
    let (part, numbers) = line.split_once(": ")?;
    let mut counts = numbers.split(", ").filter_map(|number| number.split(' ').next()?.parse().ok());
    Some((part, [counts.next()?, counts.next()?, counts.next()?]))
}

/// Calls a function with the text of every file of Rust below a folder.
fn count(folder: &Path, with: &mut impl FnMut(&str)) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let is_built = path.file_name().is_some_and(|name| name == "target" || name == "node_modules");
        if path.is_dir() && !is_built {
            count(&path, with)?;
        } else if path.extension().is_some_and(|end| end == "rs") {
            with(&fs::read_to_string(&path)?);
        }
    }
    Ok(())
}
