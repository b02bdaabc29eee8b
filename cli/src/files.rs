//! Reads files and standard input, up to a maximum size.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use planar_impact_app::check::{self, Entries, Options, Origin, Reader, reason, unusable};
use planar_impact_app::{Cause, Issue, Issues, Open, Source, decode};

const BUFFER: usize = 1 << 16;

/// Reads the text of the file at `path`, or of standard input for `-`.
///
/// # Errors
///
/// Returns one issue, which names the file, if it cannot be read, is too large, is not UTF-8 or is empty.
pub fn source(path: &Path) -> Result<Source, Issues> {
    if path.as_os_str() == "-" {
        return from_reader("<stdin>", io::stdin().lock());
    }
    let name = path.display().to_string();
    let unreadable = |error: &io::Error| decode::unreadable(&name, &format!("cannot be read: {}", reason(error)));
    let file = File::open(path).map_err(|error| unreadable(&error))?;
    let metadata = file.metadata().map_err(|error| unreadable(&error))?;
    if metadata.is_dir() {
        return Err(decode::unreadable(&name, "is a directory, not a file"));
    }
    if metadata.len() > Source::LARGEST {
        return Err(decode::too_large(&name));
    }
    from_reader(&name, file)
}

/// Returns a function that opens a file which the file at `path` names, relative to its folder, unless the call would write over it.
pub fn beside(path: &Path, written: Option<&Path>) -> Open {
    let folder = path.parent().unwrap_or(Path::new("")).to_owned();
    let written = written.map(Path::to_owned);
    Box::new(move |name| {
        let file = folder.join(name);
        is_no_input(written.as_deref(), [&file])?;
        source(&file)
    })
}

/// Refuses a file to write that the call reads, and that would be replaced by what is computed from it.
///
/// # Errors
///
/// Returns an issue for each input that is the output.
pub fn is_no_input(output: Option<&Path>, inputs: impl IntoIterator<Item = impl AsRef<Path>>) -> Result<(), Issues> {
    let Some(written) = output.filter(|output| output.as_os_str() != "-").and_then(|output| output.canonicalize().ok()) else {
        return Ok(());
    };
    let mut issues = Vec::new();
    for input in inputs {
        let input = input.as_ref();
        if input.canonicalize().is_ok_and(|read| read == written) {
            let message = format!("`{}` is read by this call, and would be replaced; name another file to write", input.display());
            issues.push(Issue::of_file("output-is-input", message));
        }
    }
    if issues.is_empty() { Ok(()) } else { Err(Issues::without_source(Cause::Input, issues)) }
}

/// Refuses a file to write whose name ends as that of another format does: who opens it would find something else.
///
/// # Errors
///
/// If the name has the ending of a format, which is none of these.
pub fn is_named_as(output: Option<&Path>, endings: &[&str]) -> Result<(), Issues> {
    const OF_FORMATS: [&str; 16] =
        ["svg", "html", "htm", "json", "jsonl", "txt", "md", "png", "jpg", "jpeg", "pdf", "docx", "parquet", "arrow", "toml", "csv"];
    let Some(output) = output else { return Ok(()) };
    let ending = output.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase);
    if !ending.is_some_and(|ending| OF_FORMATS.contains(&ending.as_str()) && !endings.contains(&ending.as_str())) {
        return Ok(());
    }
    let message = format!("`{}` has the name of another format; let it end in .{}", output.display(), endings[0]);
    Err(Issues::without_source(Cause::Input, vec![Issue::of_file("other-format", message)]))
}

/// Checks that standard input is named no more than once.
///
/// # Errors
///
/// If `-` stands twice.
pub fn is_read_once<'a>(paths: impl IntoIterator<Item = &'a PathBuf>) -> Result<(), Issues> {
    let times = paths.into_iter().filter(|path| path.as_os_str() == "-").count();
    if times > 1 { Err(Issues::without_source(Cause::Input, vec![read_twice()])) } else { Ok(()) }
}

/// Returns the issue of standard input that is named again.
pub fn read_twice() -> Issue {
    Issue::of_file("unreadable-file", "standard input can be read only once; `-` stands twice")
}

/// Reads up to the maximum size, because the length of a pipe or a device is not known in advance.
fn from_reader(name: &str, reader: impl Read) -> Result<Source, Issues> {
    let mut bytes = Vec::new();
    let read = reader.take(Source::LARGEST + 1).read_to_end(&mut bytes);
    read.map_err(|error| decode::unreadable(name, &format!("cannot be read: {}", reason(&error))))?;
    decode::source(name, bytes)
}

/// Opens a file of records, or standard input for `-`; also returns its size in bytes, if known. Counts the bytes read in `bytes`.
///
/// # Errors
///
/// Returns every issue that makes the file unusable.
pub fn records(path: &Path, options: Options, bytes: &Arc<AtomicU64>) -> Result<(Entries, Option<u64>), Issues> {
    if path.as_os_str() == "-" {
        let reader = Box::new(BufReader::with_capacity(BUFFER, io::stdin()));
        return Ok((Entries::open("<stdin>", None, Origin::Pipe(reader), options)?, None));
    }
    let name = path.display().to_string();
    let unreadable = |error: &io::Error| unusable(&name, &format!("it cannot be read: {}", reason(error)));
    let file = File::open(path).map_err(|error| unreadable(&error))?;
    let metadata = file.metadata().map_err(|error| unreadable(&error))?;
    if metadata.is_dir() {
        return Err(unusable(&name, "it is a directory, not a file of records"));
    }
    let extension = path.extension().and_then(|end| end.to_str()).map(str::to_ascii_lowercase);
    let (origin, size) = if metadata.is_file() {
        (Origin::File(opener(path.to_owned(), bytes.clone())), Some(metadata.len()))
    } else {
        (Origin::Pipe(Box::new(BufReader::with_capacity(BUFFER, file))), None)
    };
    Ok((Entries::open(&name, extension.as_deref(), origin, options)?, size))
}

/// Returns a function that opens the file each time it is called: first to validate it, then to read it.
fn opener(path: PathBuf, bytes: Arc<AtomicU64>) -> check::Open {
    Box::new(move || -> io::Result<Reader> {
        bytes.store(0, Ordering::Relaxed);
        Ok(Box::new(BufReader::with_capacity(BUFFER, Counted::new(File::open(&path)?, &bytes))))
    })
}

/// Counts the bytes that have been read.
pub struct Counted {
    file: File,
    bytes: Arc<AtomicU64>,
}

impl Counted {
    /// Counts the bytes read from a file in `bytes`.
    pub fn new(file: File, bytes: &Arc<AtomicU64>) -> Counted {
        Counted { file, bytes: bytes.clone() }
    }
}

impl Read for Counted {
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        let read = self.file.read(to)?;
        self.bytes.fetch_add(read as u64, Ordering::Relaxed);
        Ok(read)
    }
}

impl Seek for Counted {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_that_cannot_be_read() {
        let read = |path: &str| source(Path::new(path)).unwrap_err().to_string();
        assert_eq!(read("/no/such"), "`/no/such` cannot be read: there is no such file");
        assert_eq!(read("/"), "`/` is a directory, not a file");
    }

    #[test]
    fn endless_input_is_refused_after_the_largest_size() {
        let refused = from_reader("<stdin>", io::repeat(b'a')).unwrap_err().to_string();
        assert_eq!(refused, "`<stdin>` is larger than 4 MiB, the most that is read of a file");
    }

    #[test]
    fn a_large_file_is_refused_unread() {
        let path = std::env::temp_dir().join(format!("planar-impact-large-{}", std::process::id()));
        File::create(&path).and_then(|file| file.set_len(1 << 30)).unwrap(); // sparse
        let refused = source(&path).unwrap_err().to_string();
        std::fs::remove_file(&path).unwrap();
        assert!(refused.ends_with("is larger than 4 MiB, the most that is read of a file"), "{refused}");
    }
}
