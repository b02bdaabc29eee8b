//! Arguments of `batch`.

use std::path::PathBuf;

use clap::Args;

use super::whole;

/// Arguments of `batch`.
#[derive(Debug, Args)]
pub struct Batch {
    /// Tables of the same columns: .csv, .parquet or .arrow; - reads CSV from standard input.
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// The table to write: .csv, .parquet or .arrow; - writes CSV to standard output.
    #[arg(long, short, value_name = "OUT")]
    pub output: PathBuf,
    /// A case file that supplies what no column has, TOML or JSON.
    #[arg(long, value_name = "CASE")]
    pub case: Option<PathBuf>,
    /// Outputs, by name or symbol; may be repeated. Default: all of `solve`.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub of: Vec<String>,
    /// Inputs to differentiate with respect to, by name or symbol; may be repeated.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub wrt: Vec<String>,
    /// Check each solved row with the laws of mechanics, and add a column with the rules that it violates.
    #[arg(long)]
    pub check: bool,
    /// Number of threads that solve rows. Default: one for each processor. The bits of the answer do not depend on it.
    #[arg(long, value_name = "COUNT", value_parser = whole::<u16>(1..=1024))]
    pub threads: Option<u16>,
    /// Fuse multiplications and additions where the machine can, which is faster: the last bits then differ between machines.
    #[arg(long)]
    pub fast: bool,
    /// Stop at the first row that is refused, and write no file.
    #[arg(long)]
    pub fail_fast: bool,
}
