//! Reading the text of a case file, with a bound on what is read.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::report::{Problem, Problems};

/// The largest case file, in bytes. A real one has a few thousand.
const LARGEST: u64 = 4 << 20;

/// The text of a case file and the name messages give it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// The path as given, or `<stdin>`.
    pub name: String,
    /// All of it, without a byte order mark.
    pub text: String,
}

impl Source {
    /// Reads the file at `path`, or standard input for `-`.
    ///
    /// # Errors
    ///
    /// One problem that names the file: when it cannot be read, is too large, is not UTF-8 or has
    /// nothing in it.
    pub fn read(path: &Path) -> Result<Source, Problems> {
        if path.as_os_str() == "-" {
            return Source::from_reader("<stdin>", io::stdin().lock());
        }
        let name = path.display().to_string();
        let unreadable = |error: &io::Error| refusal(&name, &format!("cannot be read: {}", reason(error)));
        let file = File::open(path).map_err(|error| unreadable(&error))?;
        let metadata = file.metadata().map_err(|error| unreadable(&error))?;
        if metadata.is_dir() {
            return Err(refusal(&name, "is a directory, not a case file"));
        }
        if metadata.len() > LARGEST {
            return Err(too_large(&name));
        }
        Source::from_reader(&name, file)
    }

    /// Reads at most the largest size from `reader`: the length of a pipe or a device is not known
    /// beforehand.
    fn from_reader(name: &str, reader: impl Read) -> Result<Source, Problems> {
        let mut bytes = Vec::new();
        reader.take(LARGEST + 1).read_to_end(&mut bytes).map_err(|error| refusal(name, &format!("cannot be read: {}", reason(&error))))?;
        if bytes.len() as u64 > LARGEST {
            return Err(too_large(name));
        }
        Source::from_bytes(name, bytes)
    }

    fn from_bytes(name: &str, mut bytes: Vec<u8>) -> Result<Source, Problems> {
        if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
            return Err(refusal(name, "is UTF-16; save it as UTF-8"));
        }
        let mark = if bytes.starts_with(&[0xef, 0xbb, 0xbf]) { 3 } else { 0 };
        bytes.drain(..mark);
        let text = String::from_utf8(bytes).map_err(|error| {
            let at = error.utf8_error().valid_up_to() + mark;
            refusal(name, &format!("is not UTF-8 text: the byte at offset {at} is not valid"))
        })?;
        if text.trim().is_empty() {
            return Err(refusal(name, "is empty"));
        }
        Ok(Source { name: name.to_owned(), text })
    }
}

/// The usual reasons without the operating system's numbers.
fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        _ => error.to_string(),
    }
}

fn too_large(name: &str) -> Problems {
    refusal(name, &format!("is larger than {} MiB, which no case file is", LARGEST >> 20))
}

/// A problem with the file as a whole.
fn refusal(name: &str, what: &str) -> Problems {
    let source = Source { name: name.to_owned(), text: String::new() };
    Problems::new(source.into(), vec![Problem::of_file(format!("`{name}` {what}"))])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(read: Result<Source, Problems>) -> String {
        read.unwrap_err().render(false)
    }

    #[test]
    fn texts() {
        let text = |bytes: &[u8]| Source::from_bytes("a", bytes.to_vec()).map(|source| source.text);
        assert_eq!(text(b"\xef\xbb\xbfa = 1\r\n").unwrap(), "a = 1\r\n"); // mark skipped, CRLF kept
        let refused = |bytes: &[u8]| message(Source::from_bytes("a.toml", bytes.to_vec()));
        assert_eq!(refused(b"\xff\xfea\0"), "error: `a.toml` is UTF-16; save it as UTF-8");
        assert_eq!(refused(b"\xef\xbb\xbfab\xff"), "error: `a.toml` is not UTF-8 text: the byte at offset 5 is not valid");
        for empty in [&b""[..], b" \r\n\t", b"\xef\xbb\xbf\n"] {
            assert_eq!(refused(empty), "error: `a.toml` is empty");
        }
    }

    #[test]
    fn files_that_cannot_be_read() {
        let read = |path: &str| message(Source::read(Path::new(path)));
        assert_eq!(read("/no/such"), "error: `/no/such` cannot be read: there is no such file");
        assert_eq!(read("/"), "error: `/` is a directory, not a case file");
    }

    #[test]
    fn endless_input_is_refused_after_the_largest_size() {
        let refused = message(Source::from_reader("<stdin>", io::repeat(b'a')));
        assert_eq!(refused, "error: `<stdin>` is larger than 4 MiB, which no case file is");
    }

    #[test]
    fn a_large_file_is_refused_unread() {
        let path = std::env::temp_dir().join(format!("planar-impact-large-{}", std::process::id()));
        File::create(&path).and_then(|file| file.set_len(1 << 30)).unwrap(); // sparse
        let refused = message(Source::read(&path));
        std::fs::remove_file(&path).unwrap();
        assert!(refused.ends_with("is larger than 4 MiB, which no case file is"), "{refused}");
    }
}
