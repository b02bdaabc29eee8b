//! Lengths that an Arrow file states, checked against its size before it is read: the reader allocates whatever they say.

use std::error::Error;
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};

use arrow_ipc::{Block, Message, root_as_footer, root_as_message};

/// Marks that a length of four bytes follows; older streams begin with the length itself.
const CONTINUATION: [u8; 4] = [0xff; 4];

/// The end of a file: the length of the footer, and these bytes.
const MAGIC: &[u8; 6] = b"ARROW1";

/// Most bytes of a compressed column of a batch once it is decompressed.
const MOST_DECOMPRESSED: i64 = 1 << 30;

/// Checks every length of a stream, or of a file with a footer, and returns to its start. Counts its dictionaries.
///
/// # Errors
///
/// If it cannot be read, or states more bytes than it has.
pub fn check(mut file: &File, has_footer: bool) -> Result<usize, Box<dyn Error>> {
    let size = file.seek(SeekFrom::End(0))?;
    let stated = Stated { file, size };
    let dictionaries = if has_footer { stated.blocks()? } else { stated.messages()? };
    file.rewind()?;
    Ok(dictionaries)
}

struct Stated<'a> {
    file: &'a File,
    size: u64,
}

impl Stated<'_> {
    /// Reads a number of bytes at a place, which the file must have.
    fn bytes(&self, at: u64, length: u64) -> Result<Vec<u8>, Box<dyn Error>> {
        self.end(at, length)?;
        let mut bytes = vec![0; usize::try_from(length)?];
        let mut file = self.file;
        file.seek(SeekFrom::Start(at))?;
        file.read_exact(&mut bytes)?;
        Ok(bytes)
    }

    /// Returns the end of a part of the file.
    fn end(&self, at: u64, length: u64) -> Result<u64, Box<dyn Error>> {
        let end = at.checked_add(length).filter(|end| *end <= self.size);
        end.ok_or_else(|| format!("it states {length} bytes at byte {at}, and has {}", self.size).into())
    }

    /// The messages of a stream, one after the other.
    fn messages(&self) -> Result<usize, Box<dyn Error>> {
        let (mut at, mut dictionaries) = (0, 0);
        while at < self.size {
            let mut prefix = self.bytes(at, 4)?;
            at += 4;
            if prefix == CONTINUATION {
                prefix = self.bytes(at, 4)?;
                at += 4;
            }
            let length = length_of(&prefix)?;
            if length == 0 {
                let rest = self.size - at;
                return match rest {
                    0 => Ok(dictionaries),
                    _ => Err(format!("{rest} bytes follow the end of its stream; give each stream a file").into()),
                };
            }
            let metadata = self.bytes(at, length)?;
            let message = root_as_message(&metadata).map_err(|wrong| wrong.to_string())?;
            dictionaries += usize::from(message.header_as_dictionary_batch().is_some());
            at = self.body(&message, at + length)?;
        }
        Ok(dictionaries)
    }

    /// The blocks that the footer of a file lists.
    fn blocks(&self) -> Result<usize, Box<dyn Error>> {
        let end = self.bytes(self.size.saturating_sub(10), 10)?;
        let Some(length) = end.strip_suffix(MAGIC) else { return Err("it does not end as an Arrow file".into()) };
        let length = length_of(length)?;
        let footer = self.bytes((self.size - 10).checked_sub(length).ok_or("its footer is longer than the file")?, length)?;
        let footer = root_as_footer(&footer).map_err(|wrong| wrong.to_string())?;
        for block in [footer.dictionaries(), footer.recordBatches()].into_iter().flatten().flatten() {
            self.block(block)?;
        }
        Ok(footer.dictionaries().map_or(0, |dictionaries| dictionaries.len()))
    }

    fn block(&self, block: &Block) -> Result<(), Box<dyn Error>> {
        let (at, length) = (u64::try_from(block.offset())?, u64::try_from(block.metaDataLength())?);
        let metadata = self.bytes(at, length)?;
        let prefix = if metadata.starts_with(&CONTINUATION) { 8 } else { 4 };
        let message = metadata.get(prefix..).ok_or("a block of it has no message")?;
        self.end(at + length, u64::try_from(block.bodyLength())?)?;
        self.body(&root_as_message(message).map_err(|wrong| wrong.to_string())?, at + length)?;
        Ok(())
    }

    /// The body of a message, and the columns that are compressed in it. Returns its end.
    fn body(&self, message: &Message<'_>, at: u64) -> Result<u64, Box<dyn Error>> {
        let end = self.end(at, u64::try_from(message.bodyLength())?)?;
        let batch = message.header_as_record_batch().or_else(|| message.header_as_dictionary_batch()?.data());
        let Some(batch) = batch.filter(|batch| batch.compression().is_some()) else { return Ok(end) };
        for buffer in batch.buffers().into_iter().flatten().filter(|buffer| buffer.length() > 0) {
            let decompressed = self.bytes(at.checked_add(u64::try_from(buffer.offset())?).ok_or("a column of it has no place")?, 8)?;
            let decompressed = i64::from_le_bytes(decompressed.as_slice().try_into()?);
            if decompressed > MOST_DECOMPRESSED {
                return Err(format!("a column of it has {decompressed} bytes when decompressed; write it in batches of fewer rows").into());
            }
        }
        Ok(end)
    }
}

fn length_of(bytes: &[u8]) -> Result<u64, Box<dyn Error>> {
    Ok(u64::try_from(i32::from_le_bytes(bytes.try_into()?))?)
}
