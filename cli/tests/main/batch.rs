//! The verb `batch`: each format, what passes through, refused rows, and calls that fail.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use arrow_array::builder::StringDictionaryBuilder;
use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int32Type};
use arrow_array::{Array, ArrayRef, Date32Array, Float64Array, RecordBatch, StringArray};
use arrow_ipc::CompressionType;
use arrow_ipc::reader::FileReader;
use arrow_ipc::writer::{FileWriter, IpcWriteOptions, StreamWriter};
use arrow_schema::{DataType, Field, Schema};
use arrow_select::concat::concat_batches;
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::basic::Compression;
use parquet::file::properties::WriterProperties;
use planar_impact::batch::Instructions;
use serde_json::Value;

use crate::process::{Folder, Run, run, run_with_input, workspace};

const POSITION_A: &str = "cli/examples/position-a.toml";
const CRASHES: &str = "cli/examples/batch/crashes.csv";

fn batch(arguments: &[&str]) -> Run {
    run(&workspace(), &[&["batch"], arguments].concat())
}

fn rows(text: &str) -> Vec<Vec<String>> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_bytes());
    reader.records().map(|record| record.expect("a row").iter().map(str::to_owned).collect()).collect()
}

fn text(path: &Path) -> &str {
    path.to_str().expect("a plain path")
}

/// The output of `solve` with this name; vehicles are counted from 1.
fn solved(document: &Value, name: &str) -> f64 {
    let name = name.strip_prefix("result.").unwrap_or(name);
    let at = |vector: &str, i: usize| (vector.to_owned(), Some(i));
    let (path, component) = match name.rsplit_once('.') {
        Some((vector, "x")) if vector.ends_with("velocity") || vector.ends_with("delta_v") => at(vector, 0),
        Some((vector, "y")) if vector.ends_with("velocity") || vector.ends_with("delta_v") => at(vector, 1),
        _ => (name.to_owned(), None),
    };
    let path = path.replace("vehicle.1", "vehicles.0").replace("vehicle.2", "vehicles.1");
    let found = path.split('.').fold(document, |value, key| key.parse::<usize>().map_or(&value[key], |i| &value[i]));
    component.map_or(found, |i| &found[i]).as_f64().unwrap_or_else(|| panic!("{name}"))
}

/// Of a case against a barrier a row makes one of two vehicles, whose yaw rate may be left out as in any case.
#[test]
fn a_row_may_have_a_vehicle_for_the_barrier_of_its_case() {
    let folder = Folder::new();
    let vehicle = "mass = 1163\nyaw_inertia = 1945\nheading = \"180 deg\"\nspeed = 17.8816\nimpact_center = [1.94, 0.3]\n";
    let case = folder.write(
        "case.toml",
        format!("schema = 1\n[[vehicle]]\n{vehicle}[[vehicle]]\nbarrier = true\n[contact]\ncrush_plane = 0\nrestitution = 0.1\n")
            .as_bytes(),
    );
    let names = ["barrier", "mass", "heading [deg]", "yaw_inertia", "speed", "impact_center.forward", "impact_center.left"];
    let header: Vec<String> = names.iter().map(|name| format!("vehicle.2.{name}")).collect();
    let table = format!("{}\nfalse,2000,90,4000,10,-1,-2.4\ntrue,,,,,,\n", header.join(","));
    let done = run_with_input(&["batch", "-", "-o", "-", "--case", text(&case), "--of", "dV1"], &table);
    assert_eq!(done.status, 0, "{}{}", done.out, done.err);
    let second = "mass = 2000\nyaw_inertia = 4000\nheading = \"90 deg\"\nspeed = 10\nimpact_center = [-1, -2.4]\n";
    let solved_case = format!("schema = 1\n[[vehicle]]\n{vehicle}[[vehicle]]\n{second}[contact]\ncrush_plane = 0\nrestitution = 0.1\n");
    let document: Value = serde_json::from_str(&run_with_input(&["solve", "-", "--format", "json"], &solved_case).out).expect("JSON");
    let found = rows(&done.out);
    let at = found[0].iter().position(|name| name.contains("delta_v")).expect("the output");
    assert_eq!(found[1][at].parse::<f64>().ok(), Some(solved(&document, &found[0][at])), "{}", done.out);
}

/// Standard input is one table, and a file is what its first bytes say.
#[test]
fn what_is_no_table_is_told_as_what_it_is() {
    let folder = Folder::new();
    let twice = run_with_input(&["batch", "-", "--case", "-", "-o", "-"], "vehicle.1.speed\n10\n");
    assert_eq!((twice.status, twice.err.contains("`-` stands twice")), (2, true), "{}", twice.err);
    for (name, bytes, is) in [
        ("a.csv", &b"\x1f\x8b\x08\0"[..], "compressed by gzip"),
        ("b.csv", b"PK\x03\x04", "a workbook"),
        ("c.csv", b"PAR1", "Parquet; give it as a file whose name ends in .parquet"),
        ("d.parquet", b"ARROW1\0\0", "Arrow; give it as a file whose name ends in .arrow"),
        ("e.arrow", b"FEA1", "Feather of version 1"),
        ("f.parquet", b"vehicle.1.speed\n10\n", "is not Parquet, as its name says; let the name of a table in text end in .csv"),
    ] {
        let path = folder.write(name, bytes);
        let refused = batch(&[text(&path), "-o", "-", "--case", POSITION_A]);
        assert_eq!((refused.status, refused.err.contains(is)), (2, true), "{name}: {}", refused.err);
    }
    let case = text(&workspace().join(POSITION_A)).to_owned();
    let piped = run_with_input(&["batch", "-", "--case", &case, "-o", "-"], "PAR1\u{15}\0,\u{15}");
    assert_eq!((piped.status, piped.err.contains("`<stdin>` is Parquet; give it as a file")), (2, true), "{}", piped.err);
}

#[test]
fn a_row_has_the_numbers_of_solve() {
    let table = batch(&["-", "-o", "-", "--case", POSITION_A]);
    assert_eq!(table.status, 2, "an empty input has no header: {}", table.err);
    // The unit of a speed in the case is not that of the column.
    let input = "vehicle.1.speed [mph],contact.restitution,id\n,,as it is\n30,0.1,faster\n";
    let case = text(&workspace().join(POSITION_A)).to_owned();
    let table = run_with_input(&["batch", "-", "-o", "-", "--case", &case], input);
    assert_eq!((table.status, table.err.lines().count()), (0, 1));
    assert!(table.err.starts_with("warning: no input of the row has a number"), "{}", table.err);
    let table = rows(&table.out);
    assert_eq!(table[0][..3], ["vehicle.1.speed [mph]", "contact.restitution", "id"]);
    let faster = fs::read_to_string(workspace().join(POSITION_A)).expect("the example");
    let faster = faster.replacen("speed = \"40 ft/s\"", "speed = \"30 mph\"", 1).replace("restitution = 0", "restitution = 0.1");
    for (row, case) in [(1, fs::read_to_string(&case).expect("the example")), (2, faster)] {
        let document: Value = serde_json::from_str(&run_with_input(&["solve", "-", "--format", "json"], &case).out).expect("JSON");
        let mut names = 0;
        for (name, cell) in table[0].iter().zip(&table[row]).skip(3).filter(|(name, _)| *name != "refusal") {
            assert_eq!(cell.parse::<f64>().map(f64::to_bits), Ok(solved(&document, name).to_bits()), "{name}");
            names += 1;
        }
        assert_eq!(names, 30, "every output: {:?}", table[0]);
        assert_eq!(table[row].last().map(String::as_str), Some(""));
    }
}

#[test]
fn of_several_tables_each_refused_row_is_named_in_its_own() {
    let folder = Folder::new();
    let case = workspace().join(POSITION_A);
    folder.write("one.csv", b"vehicle.1.speed,contact.restitution\n10,0.1\n20,2\n");
    folder.write("two.csv", b"vehicle.1.speed,contact.restitution\n10,0.1\n20,x\n30,1.5\n");
    let solve = |rest: &[&str]| run(folder.path(), &[&["batch", "-o", "-", "--of", "T_L", "--case", text(&case)], rest].concat());
    let said = solve(&["one.csv", "two.csv"]).err;
    let said: Vec<&str> = said.lines().collect();
    assert_eq!(said[0], "row 2 (row 2 of `one.csv`): out-of-range: contact.restitution is 2; it must be from 0 to 1");
    assert!(said[1].starts_with("row 4 (row 2 of `two.csv`): unreadable: "), "{}", said[1]);
    assert!(said[2].starts_with("row 5 (row 3 of `two.csv`): out-of-range: "), "{}", said[2]);
    let first = solve(&["two.csv", "one.csv", "--fail-fast"]);
    assert!(first.status == 2 && first.err.contains("row 2 (row 2 of `two.csv`)"), "{}", first.err);
}

#[test]
fn a_column_that_may_be_meant_as_an_input_is_named() {
    let case = workspace().join(POSITION_A);
    let done = run_with_input(&["batch", "-", "-o", "-", "--case", text(&case), "--of", "T_L"], "vehicle.1.speed,e,site\n10,0.1,a\n");
    assert_eq!(done.err, "warning: the column `e` passes through unread; as an input it is named contact.restitution\n");
    assert_eq!(done.status, 0);
}

/// Inches that are taken for meters, of which `crush` warns too.
#[test]
fn unusual_crush_is_named_by_its_row() {
    let case = workspace().join("cli/examples/cavalier-crush.toml");
    let said = |table: &str| run_with_input(&["batch", "-", "-o", "-", "--case", text(&case), "--of", "T_L"], table).err;
    let deep = said("vehicle.1.crush.depths.1\n0.1\n12\n16\n");
    assert!(deep.contains("12.00 m is deeper than the structure of a car") && deep.contains("(row 2, and 1 more)"), "{deep}");
    assert_eq!(said("vehicle.1.crush.depths.1\n0.1\n0.2\n"), "");
}

/// Other signs between the words of an input, and a row of a spreadsheet that has no number at all.
#[test]
fn columns_with_other_signs_and_rows_without_numbers_are_named() {
    let case = workspace().join(POSITION_A);
    let said = |table: &str| run_with_input(&["batch", "-", "-o", "-", "--case", text(&case), "--of", "T_L"], table).err;
    for name in ["vehicles.2.speed", "vehicle 2 speed", "Vehicle_2_Speed"] {
        let said = said(&format!("vehicle.1.speed,{name}\n10,5\n"));
        assert!(said.contains(&format!("`{name}` passes through unread; as an input it is named vehicle.2.speed")), "{said}");
    }
    for (name, input) in [
        ("veh2.mass", "vehicle.2.mass"),
        ("v1.mass", "vehicle.1.mass"),
        ("Speed 2", "vehicle.2.speed"),
        ("yaw rate 2", "vehicle.2.yaw_rate"),
        ("contacts.restitution", "contact.restitution"),
        ("Γ", "contact.crush_plane"),
        ("μ", "contact.impulse_ratio"),
        ("COR", "contact.restitution"),
        ("V2 (mph)", "vehicle.2.speed [mph]"),
        ("v_2", "vehicle.2.speed"),
        ("weight2", "vehicle.2.mass"),
        ("speed_2_mph", "vehicle.2.speed [mph]"),
        ("Vehicle2_Speed_mph", "vehicle.2.speed [mph]"),
        ("mass2_lb", "vehicle.2.mass [lb]"),
        ("b2.mass", "vehicle.2.mass"),
        ("gamma", "contact.crush_plane"),
        ("crush_plane_deg", "contact.crush_plane [deg]"),
        ("V2_mph", "vehicle.2.speed [mph]"),
        ("Vehicle 2 Speed (mph)", "vehicle.2.speed [mph]"),
        ("crush plane", "contact.crush_plane"),
        ("impulse ratio", "contact.impulse_ratio"),
        ("coefficient of restitution", "contact.restitution"),
        ("friction coefficient", "contact.friction"),
        ("input.vehicle.2.speed", "vehicle.2.speed"),
        ("model.restitution", "contact.restitution"),
    ] {
        let said = said(&format!("vehicle.1.speed,{name}\n10,5\n"));
        assert!(said.contains(&format!("`{name}` passes through unread; as an input it is named {input}")), "{said}");
    }
    let with_unit = said("vehicle.1.speed [mph],m2 [lb],omega_2 [deg/s]\n10,5,1\n");
    assert!(with_unit.contains("is named vehicle.2.mass [lb]") && with_unit.contains("is named vehicle.2.yaw_rate [deg/s]"), "{with_unit}");
    let mixed = "vehicle.1.speed has no unit and is read in m/s, beside vehicle.2.speed, which has one";
    assert!(said("vehicle.1.speed,vehicle.2.speed [mph]\n10,5\n").contains(mixed));
    assert_eq!(said("vehicle.1.speed [km/h],vehicle.2.speed [mph],contact.restitution\n10,5,0.1\n"), "");
    let beside = said("vehicle.2.mass [lb],vehicle.1.speed,vehicle.1.heading\n2000,10,3\n");
    let si =
        "note: read in SI for want of a unit: vehicle.1.speed [m/s], vehicle.1.heading [rad]; write the unit of each behind its name\n";
    assert_eq!(beside.split_whitespace().collect::<Vec<_>>(), si.split_whitespace().collect::<Vec<_>>());
    let angles = "note: read in radians for want of a unit: vehicle.1.heading, contact.crush_plane; write [deg] or [deg/s] behind the name of one in degrees\n";
    assert_eq!(said("vehicle.1.heading,contact.crush_plane,vehicle.2.speed\n3.1,0.1,9\n"), angles);
    // What stands behind the brackets is no unit, and the symbol of an input names it.
    for (header, remedy) in [
        ("vehicle.1.speed [mph] note", "write the unit in brackets: `vehicle.1.speed [mph]`"),
        ("vehicle.1.speed {mph}", "write the unit in brackets: `vehicle.1.speed [mph]`"),
        ("vehicle.1.speed_mph", "write the unit in brackets: `vehicle.1.speed [mph]`"),
        ("vehicle.1.speed-mph", "write the unit in brackets: `vehicle.1.speed [mph]`"),
        ("vehicle.1.speed in mph", "write the unit in brackets: `vehicle.1.speed [mph]`"),
        ("vehicle.1.mass_lb", "write the unit in brackets: `vehicle.1.mass [lb]`"),
        ("vehicle.1.yaw_rate_rpm", "write the unit in brackets: `vehicle.1.yaw_rate [rpm]`"),
        ("vehicle.1.weight_lb", "a table has no weights"),
        ("vehicle.1.mass.sd", "did you mean `vehicle.1.mass`?"),
        ("contact.mu", "did you mean `contact.impulse_ratio`?"),
        ("vehicle.2.m", "did you mean `vehicle.2.mass`?"),
        ("vehicle.2.vx", "did you mean `vehicle.2.velocity.x`?"),
    ] {
        let said = said(&format!("contact.restitution,{header}\n0.1,5\n")).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(said.contains(remedy), "{header}: {said}");
    }
    // A speed has no component across the heading, which this case has.
    let crabbed = |header: &str| {
        let case = workspace().join("cli/examples/crabbed-barrier.toml");
        run_with_input(&["batch", "-", "-o", "-", "--case", text(&case), "--of", "T_L"], &format!("{header}\n10\n"))
    };
    let warning = "warning: vehicle.1.speed: it replaces the whole velocity of the case, and the component across the heading is lost; to keep it, write the \
                   columns vehicle.1.velocity.x and vehicle.1.velocity.y";
    let said_of = |header: &str| crabbed(header).err.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(said_of("vehicle.1.speed"), warning);
    assert_eq!(said_of("vehicle.1.velocity.x"), "");
    assert_eq!(said("vehicle.1.speed,speedometer 2,car,site 1,mass spectrum_m\n10,5,1,1,1\n"), "");
    // A name of a megabyte has no unit behind each of its signs.
    assert_eq!(said(&format!("vehicle.1.speed,vehicle.2.speed,{}\n10,5,1\n", "x_".repeat(1 << 19))), "");
    assert_eq!(said("vehicle.1.speed,contact.restitution\n10,\n,0.2\n"), "");
    let said = said("vehicle.1.speed,contact.restitution,site\n10,0.1,a\n,,\n,,b\n");
    assert!(said.contains("no input of the row has a number") && said.contains("row 2"), "{said}");
}

#[test]
fn the_example_says_why_rows_are_refused() {
    let table = batch(&[CRASHES, "-o", "-", "--of", "T_L,dV1", "--wrt", "e", "--check"]);
    assert_eq!(table.status, 1);
    let said: Vec<&str> = table.err.lines().collect();
    assert_eq!(said[0], "row 5: conflict: contact.impulse_ratio and contact.friction exclude each other");
    assert!(said[1].starts_with("row 6: separating: vehicles are separating"), "{}", said[1]);
    assert_eq!(said[2], "row 7: unreadable: vehicle.1.speed is `fast`; it must be a number, without a unit and with a point");
    assert_eq!(said[3..], ["3 of 7 rows refused: 1 conflict, 1 separating, 1 unreadable"]);
    let table = rows(&table.out);
    let given = rows(&fs::read_to_string(workspace().join(CRASHES)).expect("the example"));
    let width = given[0].len();
    let added = ["energy.loss", "vehicle.1.delta_v_magnitude", "d energy.loss / d contact.restitution"];
    assert_eq!(table[0][width..width + 3], added);
    assert_eq!(table[0][width + 3..], ["d vehicle.1.delta_v_magnitude / d contact.restitution", "check", "refusal"]);
    for (row, (solved, given)) in table.iter().zip(&given).enumerate().skip(1) {
        assert_eq!(solved[..width], given[..], "what is given passes through");
        let numbers = solved[width..width + 4].iter().filter(|cell| cell.parse::<f64>().is_ok_and(f64::is_finite)).count();
        assert_eq!(numbers, if row < 5 { 4 } else { 0 }, "{solved:?}");
    }
    let refusals: Vec<&str> = table.iter().filter_map(|row| row.last()).map(String::as_str).collect();
    assert_eq!(refusals, ["refusal", "", "", "", "", "conflict", "separating", "unreadable"]);
}

/// A table with a number that is missing, and columns of other types that pass through.
fn table() -> RecordBatch {
    let mut sites = StringDictionaryBuilder::<Int32Type>::new();
    ["north", "south", "north"].into_iter().for_each(|site| sites.append_value(site));
    let columns: [(&str, ArrayRef); 4] = [
        ("site", Arc::new(sites.finish())),
        ("vehicle.1.speed [mph]", Arc::new(Float64Array::from(vec![Some(30.0), None, Some(-30.0)]))),
        ("day", Arc::new(Date32Array::from(vec![0, 1, 20_000]))),
        ("note", Arc::new(StringArray::from(vec![Some("x, \"y\""), None, Some("")]))),
    ];
    RecordBatch::try_from_iter_with_nullable(columns.map(|(name, array)| (name, array, true))).expect("columns of one length")
}

fn read(path: &Path) -> RecordBatch {
    let file = fs::File::open(path).expect("a table");
    let read: Vec<RecordBatch> = match path.extension().and_then(|end| end.to_str()) {
        Some("parquet") => {
            ParquetRecordBatchReaderBuilder::try_new(file).expect("a table").build().expect("a table").map(Result::unwrap).collect()
        }
        _ => FileReader::try_new(file, None).expect("a table").map(Result::unwrap).collect(),
    };
    concat_batches(&read[0].schema(), &read).expect("parts of one table")
}

#[test]
fn every_format_has_the_same_numbers() {
    let folder = Folder::new();
    let at = |name: &str| folder.path().join(name);
    let create = |name: &str| fs::File::create(at(name)).expect("a file");
    let (table, schema) = (table(), table().schema());
    for (name, compression) in [
        ("plain", Compression::UNCOMPRESSED),
        ("snappy", Compression::SNAPPY),
        ("gzip", Compression::GZIP(Default::default())),
        ("zstd", Compression::ZSTD(Default::default())),
    ] {
        let properties = WriterProperties::builder().set_compression(compression).build();
        let mut writer = ArrowWriter::try_new(create(&format!("{name}.parquet")), schema.clone(), Some(properties)).expect("a writer");
        writer.write(&table).and_then(|()| writer.close().map(drop)).expect("it is written");
    }
    let compressed = IpcWriteOptions::default().try_with_compression(Some(CompressionType::LZ4_FRAME)).expect("a compression");
    let mut writer = FileWriter::try_new_with_options(create("lz4.arrow"), &schema, compressed).expect("a writer");
    writer.write(&table).and_then(|()| writer.finish()).expect("it is written");
    let mut writer = StreamWriter::try_new(create("stream.arrow"), &schema).expect("a writer");
    writer.write(&table).and_then(|()| writer.finish()).expect("it is written");

    let of_case = ["--case", POSITION_A, "--of", "W_n,dV1"];
    let csv = "site,vehicle.1.speed [mph],day,note\nnorth,30,1970-01-01,\"x, \"\"y\"\"\"\nsouth,,1970-01-02,\nnorth,-30,2024-10-04,\n";
    fs::write(at("text.csv"), csv).expect("a table");
    let solve = |input: &str, output: &str| {
        let (input, output) = (at(input), at(output));
        let done = batch(&[&[text(&input), "-o", text(&output)], &of_case[..]].concat());
        assert_eq!(done.status, 1, "{input:?}: {}", done.err);
        output
    };
    let first = fs::read_to_string(solve("text.csv", "text-out.csv")).expect("a table");
    let numbers: Vec<Vec<Option<f64>>> =
        rows(&first)[1..].iter().map(|row| row[4..6].iter().map(|cell| cell.parse().ok()).collect()).collect();
    assert!(numbers[0][0] < Some(0.0) && numbers[1][1] > Some(0.0) && numbers[2] == [None, None], "{first}");
    for input in ["plain.parquet", "snappy.parquet", "gzip.parquet", "zstd.parquet", "lz4.arrow", "stream.arrow", "text.csv"] {
        let printed = fs::read_to_string(solve(input, "out.csv")).expect("a table");
        assert_eq!(printed.replace("30.0", "30"), first, "{input}");
        for output in ["out.parquet", "out.arrow"] {
            let answer = read(&solve(input, output));
            for (row, numbers) in numbers.iter().enumerate() {
                let found = ["energy.normal_work", "vehicle.1.delta_v_magnitude"].map(|name| {
                    let column = answer[name].as_primitive::<Float64Type>();
                    column.is_valid(row).then(|| column.value(row))
                });
                assert_eq!(found.to_vec(), *numbers, "{input} {output}");
            }
            let refusals: Vec<Option<&str>> = answer["refusal"].as_string::<i32>().iter().collect();
            assert_eq!(refusals, [None, None, Some("separating")]);
            assert_eq!(answer.schema().field_with_name("energy.normal_work").expect("a column").metadata()["unit"], "J");
            if input != "text.csv" {
                assert_eq!(answer.columns()[..4], table.columns()[..], "{input} {output}: what is given passes through");
            }
            let speeds = answer["vehicle.1.speed [mph]"].as_primitive::<Float64Type>();
            assert_eq!(speeds.iter().collect::<Vec<_>>(), [Some(30.0), None, Some(-30.0)], "{input} {output}");
        }
    }
}

/// Each size once, with the first row of it and the number of the others; a row whose cells are refused has no sizes.
#[test]
fn sizes_that_no_road_vehicle_has_are_told_at_the_end() {
    let folder = Folder::new();
    let (source, target) = (folder.path().join("in.csv"), folder.path().join("out.csv"));
    let columns =
        "vehicle.1.mass,vehicle.1.speed,vehicle.2.yaw_rate,vehicle.2.impact_center.forward,vehicle.1.radius_of_gyration,contact.friction";
    let mut table = format!("{columns}\n");
    for i in 0..20_000 {
        table += match i {
            7 => "1,120,0,2,1.2,0.5,one cell too many\n",
            // One in each of the parts that are read, and another in the last.
            4000 | 9000 | 17_000 | 17_001 => "99,12,0,2,1.2,0.5\n",
            11_000 => "1200,120,0,2,1.2,0.5\n",
            11_001 => "1200,12,-21,16,6,11\n",
            _ => "100,12,0,2,1.2,0.5\n",
        };
    }
    fs::write(&source, table).expect("a table");
    for threads in ["1", "3"] {
        let done = batch(&[text(&source), "-o", text(&target), "--case", POSITION_A, "--of", "T_L", "--threads", threads]);
        let said: Vec<&str> = done.err.lines().filter(|line| !line.starts_with("row ")).collect();
        let wanted = [
            "note: read in radians for want of a unit: vehicle.2.yaw_rate; write [deg] or [deg/s] behind the name of one in degrees",
            "warning: vehicle.1: no road vehicle has a mass of 99 kg; check its unit (row 4001, and 3 more)",
            "warning: vehicle.1: no road vehicle has a speed of 120.00 m/s; check its unit (row 11001)",
            "warning: vehicle.1: a radius of gyration of 6.00 m is unusual; check mass and yaw inertia (row 11002)",
            "warning: vehicle.2: no road vehicle has an impact center at a distance of 16.03 m; check its unit (row 11002)",
            "warning: vehicle.2: no road vehicle has a yaw rate of 1203.2 deg/s; check its unit (row 11002)",
            "warning: a friction of 11 limits nothing that two vehicles do; a share of 1 is expected, and a percentage needs its sign (row 11002)",
        ];
        assert_eq!(said[..wanted.len()], wanted, "{threads} threads");
        assert!(done.status == 1 && said[wanted.len()].contains("of 20000 rows refused: "), "{}", done.err);
    }
    fs::write(&source, "vehicle.1.mass\n100\n").expect("a table");
    let usual = batch(&[text(&source), "-o", text(&target), "--case", POSITION_A, "--of", "T_L"]);
    assert_eq!((usual.status, usual.err.as_str()), (0, ""));
}

/// A cell that a person would read is refused with what to write.
#[test]
fn a_cell_that_is_no_number_has_a_remedy() {
    let case = workspace().join(POSITION_A);
    let of = |column: &str, cell: &str| {
        let table = format!("{column}\n\"{cell}\"\n");
        run_with_input(&["batch", "-", "-o", "-", "--case", text(&case), "--of", "T_L"], &table).err
    };
    let speed = |cell: &str| of("vehicle.1.speed", cell);
    assert!(speed("12 m/s").contains("with a point; write its unit in the header, as `vehicle.1.speed [m/s]`"), "{}", speed("12 m/s"));
    assert!(speed("\u{2212}12").contains("with a point; write an ordinary minus sign"), "{}", speed("\u{2212}12"));
    assert!(speed("1,200").contains("with a point; write 1200"), "{}", speed("1,200"));
    assert!(speed("12 m/s").contains("[m/s]`, and every cell in that\n"), "{}", speed("12 m/s"));
    let of_header = of("vehicle.1.speed [m/s]", "40 mph");
    assert!(of_header.contains("; the header has the unit of the column, in which it is 17.8816\n"), "{of_header}");
    for unit in ["mph", "[mph]"] {
        assert!(
            speed(unit).contains("; write the unit in the header, as `vehicle.1.speed [mph]`, and remove the line of units\n"),
            "{}",
            speed(unit)
        );
    }
    assert!(speed("fast").contains("without a unit and with a point\n"), "{}", speed("fast"));
    assert!(of("contact.restitution", "10 %").contains("as `contact.restitution [%]`"), "{}", of("contact.restitution", "10 %"));
}

#[test]
fn threads_and_formats_change_no_bit() {
    let folder = Folder::new();
    let at = |name: &str| folder.path().join(name);
    let mut table = "vehicle.1.speed,contact.crush_plane [deg],id\n".to_owned();
    for i in 0..30_000 {
        table += &format!("{},{},{i}\n", if i % 10 == 9 { "x".to_owned() } else { format!("{}.5", i % 29) }, i % 17);
    }
    fs::write(at("in.csv"), table).expect("a table");
    let solve = |input: &str, output: &str, more: &[&str]| {
        let (input, output) = (at(input), at(output));
        let call = [&["batch", text(&input), "-o", text(&output), "--case", POSITION_A], more].concat();
        let done = run(&workspace(), &call);
        assert_eq!(done.status, 1, "{}", done.err);
        assert!(done.err.ends_with("3000 of 30000 rows refused: 3000 unreadable\n"), "{}", done.err);
        assert!(done.err.starts_with("note: read in SI for want of a unit: vehicle.1.speed [m/s]"), "{}", done.err);
        assert_eq!(done.err.lines().filter(|line| line.starts_with("row ")).count(), 10, "ten are described");
    };
    solve("in.csv", "one.csv", &["--threads", "1"]);
    let one = fs::read(at("one.csv")).expect("a table");
    for threads in ["2", "3", "7"] {
        solve("in.csv", "more.csv", &["--threads", threads]);
        assert!(fs::read(at("more.csv")).expect("a table") == one, "{threads} threads");
    }
    // Fast rows have bits of their own, and the same for any number of threads.
    solve("in.csv", "fast.csv", &["--threads", "1", "--fast"]);
    solve("in.csv", "more.csv", &["--threads", "3", "--fast"]);
    let fast = fs::read(at("fast.csv")).expect("a table");
    assert!(fs::read(at("more.csv")).expect("a table") == fast);
    assert_eq!(fast != one, cfg!(target_arch = "aarch64") || Instructions::best() != Instructions::Compiled);
    let ids: Vec<String> = rows(std::str::from_utf8(&one).expect("text"))[1..].iter().map(|row| row[2].clone()).collect();
    assert!(ids.iter().enumerate().all(|(i, id)| *id == i.to_string()), "the order of rows is kept");
    for name in ["one.parquet", "one.arrow"] {
        solve("in.csv", name, &["--threads", "1"]);
        solve("in.csv", &format!("two-{name}"), &["--threads", "2"]);
        assert!(fs::read(at(name)).ok() == fs::read(at(&format!("two-{name}"))).ok(), "{name}");
    }
}

#[test]
fn a_header_that_is_not_utf_8_is_told() {
    let folder = Folder::new();
    let path = folder.path().join("in.csv");
    let utf_16 = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    for (header, said) in [
        (b"vehicle.1.speed,v\xfc\n12,1\n".to_vec(), "has a header that is not UTF-8 text; save it as UTF-8"),
        (utf_16("\u{feff}vehicle.1.speed\n12\n"), "is UTF-16; save it as UTF-8"),
        (utf_16("vehicle.1.speed,site\n12,1\n"), "is UTF-16; save it as UTF-8"),
    ] {
        fs::write(&path, header).expect("a table");
        let refused = batch(&[text(&path), "-o", "-", "--case", POSITION_A]);
        assert!(refused.status == 2 && refused.err.contains(said), "{}", refused.err);
    }
}

/// The unit of a column stands in its metadata, under any of the keys that are read; in text it stands in the header, so that the table can be read again.
#[test]
fn a_unit_of_the_metadata_comes_back_from_text() {
    let folder = Folder::new();
    let at = |name: &str| folder.path().join(name);
    for key in ["unit", "Unit", "UNITS", " units "] {
        let metadata = [(key.to_owned(), "mph".to_owned())].into_iter().collect();
        let schema = Arc::new(Schema::new(vec![Field::new("vehicle.1.speed", DataType::Float64, true).with_metadata(metadata)]));
        let speeds: ArrayRef = Arc::new(Float64Array::from(vec![30.0]));
        let table = RecordBatch::try_new(schema.clone(), vec![speeds]).expect("a table");
        let mut writer = FileWriter::try_new(fs::File::create(at("in.arrow")).expect("a file"), &schema).expect("a writer");
        writer.write(&table).and_then(|()| writer.finish()).expect("it is written");
        let solve = |input: &str, output: &str| {
            let done = batch(&[text(&at(input)), "-o", text(&at(output)), "--case", POSITION_A, "--of", "T_L"]);
            assert_eq!(done.status, 0, "{key}: {}", done.err);
            rows(&fs::read_to_string(at(output)).expect("a table"))
        };
        let first = solve("in.arrow", "out.csv");
        assert_eq!(first[0][0], "vehicle.1.speed [mph]", "{key}");
        fs::write(at("again.csv"), format!("{}\n{}\n", first[0][0], first[1][0])).expect("a table");
        assert_eq!(solve("again.csv", "second.csv")[1], first[1], "{key}");
    }
}

/// Rows of a Parquet file are read together, and solved some at a time.
#[test]
fn a_refused_row_of_a_long_part_has_its_number() {
    let folder = Folder::new();
    let (source, target) = (folder.path().join("in.csv"), folder.path().join("out.parquet"));
    let mut table = "vehicle.1.speed,id\n".to_owned();
    for i in 0..9000 {
        table += &match i {
            4095 => "-12,4095\n".to_owned(),
            4096 => "fast,4096\n".to_owned(),
            8500 => "12,8500,one cell too many\n".to_owned(),
            _ => format!("12,{i}\n"),
        };
    }
    fs::write(&source, table).expect("a table");
    let done = batch(&[text(&source), "-o", text(&target), "--case", POSITION_A, "--of", "W_n,dV1"]);
    let said: Vec<&str> = done.err.lines().collect();
    assert!(said[0].starts_with("row 4096: separating: "), "{}", done.err);
    assert!(said[1].starts_with("row 4097: unreadable: ") && said[2].starts_with("row 8501: unreadable: "), "{}", done.err);
    assert_eq!(said[3..], ["3 of 9000 rows refused: 1 separating, 2 unreadable"]);
    let answer = read(&target);
    let refusals = answer["refusal"].as_string::<i32>();
    let refused: Vec<usize> = (0..9000).filter(|row| refusals.is_valid(*row)).collect();
    assert_eq!(refused, [4095, 4096, 8500]);
    let works = answer["energy.normal_work"].as_primitive::<Float64Type>();
    assert!((0..9000).all(|row| works.is_valid(row) != refused.contains(&row)));
    assert!(works.iter().flatten().all(|work| work == works.value(0)), "one collision");
    // One row group; computed numbers do not become smaller.
    let reader = ParquetRecordBatchReaderBuilder::try_new(fs::File::open(&target).expect("a table")).expect("a table");
    assert_eq!(reader.metadata().num_row_groups(), 1);
    let compressions: Vec<Compression> = reader.metadata().row_group(0).columns().iter().map(|column| column.compression()).collect();
    let (snappy, none) = (Compression::SNAPPY, Compression::UNCOMPRESSED);
    assert_eq!(compressions, [snappy, snappy, none, none, snappy]);
}

#[test]
fn tables_of_one_call_follow_each_other() {
    let folder = Folder::new();
    let write = |name: &str, text: &str| folder.write(name, text.as_bytes()).to_str().expect("a plain path").to_owned();
    let one = write("1.csv", "\u{feff}contact.restitution,id\r\n0.1,a\r\n0.2,b\r\n");
    let two = write("2.csv", "contact.restitution,id\n0.3,c\n");
    let done = batch(&[&one, &two, "-o", "-", "--case", POSITION_A, "--of", "e"]);
    assert_eq!((done.status, done.err.as_str()), (0, ""));
    assert_eq!(done.out, "contact.restitution,id,result.contact.restitution,refusal\n0.1,a,0.1,\n0.2,b,0.2,\n0.3,c,0.3,\n");
    let other = write("3.csv", "id,contact.restitution\nd,0.3\n");
    let done = batch(&[&one, &other, "-o", "-", "--case", POSITION_A]);
    assert_eq!((done.status, done.out.as_str()), (2, ""));
    assert!(done.err.contains("has other columns than"), "{}", done.err);
    let ragged = write("4.csv", "contact.restitution,id\n0.1\n0.1,a,b\n0.1,c\n");
    let done = batch(&[&ragged, "-o", "-", "--case", POSITION_A, "--of", "e"]);
    assert_eq!(done.status, 1);
    assert_eq!(done.out.lines().skip(1).collect::<Vec<_>>(), ["0.1,,,unreadable", "0.1,a,,unreadable", "0.1,c,0.1,"]);
    let said: Vec<&str> = done.err.lines().take(2).collect();
    let [short, long] = [
        "row 1: unreadable: the row has 1 cell, and the table has 2 columns",
        "row 2: unreadable: the row has 3 cells, and the table has 2 columns; a decimal comma?",
    ];
    assert_eq!(said, [short, long]);
    fs::write(folder.path().join("5.csv"), b"contact.restitution,id\n0.1,a\n0.1,\xff\n").expect("a table");
    let done = batch(&[folder.path().join("5.csv").to_str().expect("a plain path"), "-o", "-", "--case", POSITION_A, "--of", "e"]);
    assert!(done.status == 1 && done.err.starts_with("row 2: unreadable: a cell of the row is not UTF-8 text\n"), "{}", done.err);
}

/// What is wrong with the case is said at its place in its file, beside what is wrong with the columns; what is wrong with the folder of temporary files, with its name.
#[test]
fn what_is_wrong_beside_the_rows_is_named() {
    let folder = Folder::new();
    fs::write(folder.path().join("bad.csv"), "vehicle.1.sped\n1\n").expect("a file");
    let case = workspace().join("cli/examples/reconstruct/momentum.toml");
    let line = 1 + fs::read_to_string(&case).expect("the case").lines().position(|line| line.starts_with("model = ")).expect("a model");
    let by_momentum = run(folder.path(), &["batch", "bad.csv", "--case", case.to_str().expect("a plain path"), "-o", "-"]);
    assert!(by_momentum.status == 2 && by_momentum.err.contains(&format!("momentum.toml:{line}:")), "{}", by_momentum.err);
    let speeds = workspace().join("cli/examples/batch/speeds.csv");
    let case = workspace().join("cli/examples/position-a.toml");
    let call = ["batch", speeds.to_str().expect("a plain path"), "--case", case.to_str().expect("a plain path"), "-o", "-"];
    let run = std::process::Command::new(env!("CARGO_BIN_EXE_planar-impact")).args(call).env("TMPDIR", "/no-such-folder").output();
    let run = run.expect("it runs");
    let said = String::from_utf8(run.stderr).expect("text");
    assert!(run.status.code() == Some(74) && said.contains("/no-such-folder") && said.contains("TMPDIR"), "{said}");
}

#[test]
fn a_call_that_fails_writes_no_file() {
    let folder = Folder::new();
    let path = |name: &str| folder.path().join(name).to_str().expect("a plain path").to_owned();
    let (out, old) = (path("out.csv"), path("old.csv"));
    fs::write(&old, "old").expect("a file");
    fs::write(path("not.parquet"), "text").expect("a file");
    fs::write(path("not.arrow"), "text").expect("a file");
    fs::write(path("bad.csv"), "vehicle.1.sped,vehicle.1.mass [mph]\n1,2\n").expect("a file");
    fs::write(path("unit.csv"), "vehicle.1.speed (mph)\n40\n").expect("a file");
    fs::write(path("semicolons.csv"), "vehicle.1.speed;vehicle.1.mass\n40;1500\n").expect("a file");
    fs::write(path("other.csv"), "speed,e\n40,0.1\n").expect("a file");
    fs::write(path("commented.csv"), "# of the inquiry\nvehicle.1.speed\n40\n").expect("a file");
    fs::write(path("separator.csv"), "sep=,\nvehicle.1.speed,site\n40,a\n").expect("a file");
    fs::write(path("separating.csv"), "vehicle.1.speed\n40\n-40\n").expect("a file");
    fs::write(path("unreadable.csv"), "vehicle.1.speed\n40\nx\n").expect("a file");
    fs::write(path("tiny.csv"), "vehicle.1.speed\n1e-400\n").expect("a file");
    fs::write(path("goes-on.csv"), "vehicle.1.speed,note\n40,a\n41,\"b\"c\n42,d\n").expect("a file");
    // The last row of a part, of another, and of one that the cell after it fills.
    for rows in [1, 8192, 8193, 9000] {
        let sound = "40,\"a \"\"note\"\", sound\"\n".repeat(rows - 1);
        fs::write(path(&format!("open-{rows}.csv")), format!("vehicle.1.speed,note\n{sound}40,\"b\n41,c\n")).expect("a file");
    }
    let empty = fs::File::create(path("empty.arrow")).expect("a file");
    arrow_ipc::writer::FileWriter::try_new(empty, &arrow_schema::Schema::empty()).and_then(|mut writer| writer.finish()).expect("a table");
    let typed = RecordBatch::try_from_iter([("vehicle.1.speed", Arc::new(Float64Array::from(vec![40.0])) as ArrayRef)]).expect("a table");
    let mut writer =
        ArrowWriter::try_new(fs::File::create(path("typed.parquet")).expect("a file"), typed.schema(), None).expect("a writer");
    writer.write(&typed).and_then(|()| writer.close()).expect("a table");
    let calls: [(&[&str], i32, &str); 24] = [
        (&[&path("empty.arrow")], 2, "empty.arrow` has no columns"),
        (&[&path("separating.csv"), &path("typed.parquet")], 2, "error: the column vehicle.1.speed is Float64 in `"),
        (&[&path("open-1.csv")], 2, "cannot be read as a table: the quote that begins a cell in line 2 is never closed"),
        (&[&path("goes-on.csv")], 2, "the cell that begins in line 3 goes on after its closing quote"),
        (&[&path("open-8192.csv")], 2, "the quote that begins a cell in line 8193 is never closed"),
        (&[&path("open-8193.csv")], 2, "the quote that begins a cell in line 8194 is never closed"),
        (&[&path("open-9000.csv")], 2, "the quote that begins a cell in line 9001 is never closed"),
        (&[&path("other.csv")], 2, "no column is an input of a collision, so every row would be the case itself"),
        (&[&path("commented.csv")], 2, "the first line must name the columns, and begins with #"),
        (&[&path("separator.csv")], 2, "the first line must name the columns, and is `sep=`"),
        (&["no-such.csv"], 2, "there is no such file"),
        (&["cli"], 2, "it must end in .csv, .parquet, .arrow, .feather or .ipc"),
        (&["-", "-"], 2, "standard input can be read only once"),
        (&[&path("not.parquet")], 2, "is not Parquet, as its name says"),
        (&[&path("not.arrow")], 2, "cannot be read as a table"),
        (&[&path("unit.csv")], 2, "write the unit in brackets: `vehicle.1.speed [mph]`"),
        (&[&path("semicolons.csv")], 2, "cannot be read as a table: the columns are separated by semicolons or tabs"),
        (&[&path("bad.csv")], 2, "did you mean `vehicle.1.speed`?"),
        (&[&path("bad.csv")], 2, "is a speed; a mass is expected"),
        (&[&path("separating.csv"), "--fail-fast"], 3, "row 2: vehicles are separating"),
        (&[&path("unreadable.csv"), "--fail-fast"], 2, "row 2: vehicle.1.speed is `x`; it must be a number"),
        // As every other reader says it.
        (&[&path("tiny.csv"), "--fail-fast"], 2, "row 1: vehicle.1.speed: `1e-400` is too small"),
        (&[&path("separating.csv"), "--of", "T_X"], 2, "unknown output"),
        (&[&path("separating.csv"), "--wrt", "T_L"], 2, "this is an output, not an input"),
    ];
    let nothing = batch(&["no-such.csv", "-o", &out, "--case", "no-such.toml"]);
    for missing in ["no-such.csv", "no-such.toml"] {
        assert!(nothing.status == 2 && nothing.err.contains(missing), "{}", nothing.err);
    }
    for (arguments, status, message) in calls {
        for output in [out.as_str(), &old, "-"] {
            let done = batch(&[arguments, &["-o", output, "--case", POSITION_A]].concat());
            assert_eq!((done.status, done.out.as_str()), (status, ""), "{arguments:?}: {}", done.err);
            assert!(done.err.contains(message), "{arguments:?}: {}", done.err);
        }
    }
    let done = batch(&[CRASHES, "-o", &path("out.txt")]);
    assert!(done.status == 2 && done.err.contains("it must end in .csv"), "{}", done.err);
    let done = batch(&[CRASHES, "-o", &path("no/such/folder.csv")]);
    assert_eq!(done.status, 74, "{}", done.err);
    assert!(!Path::new(&out).exists());
    assert_eq!(fs::read_to_string(&old).expect("it is still there"), "old");
    let left: Vec<_> = fs::read_dir(folder.path()).expect("a folder").map(|entry| entry.expect("an entry").file_name()).collect();
    assert_eq!(left.len(), 19, "nothing else is left: {left:?}");
    // What is whole replaces what was there.
    assert_eq!(batch(&[&path("separating.csv"), "-o", &old, "--case", POSITION_A, "--of", "e"]).status, 1);
    assert!(fs::read_to_string(&old).expect("a table").starts_with("vehicle.1.speed,result.contact.restitution,refusal\n40,0.0,\n"));
}

#[test]
fn cells_are_refused_as_in_a_case() {
    let case = text(&workspace().join(POSITION_A)).to_owned();
    let table = "vehicle.1.yaw_rate,vehicle.1.speed [mph]\n0,30\n1e-400,30\n-0.0e-999,30\n0,1e-400\n4e-324,30\n0,2e-324\n0,5e-324\n";
    let run = run_with_input(&["batch", "-", "-o", "-", "--case", &case, "--of", "e"], table);
    let refusals: Vec<String> = rows(&run.out).iter().skip(1).map(|row| row[3].clone()).collect();
    // 4e-324 is the least float, 5e-324; in mph it becomes none of m/s.
    assert_eq!(refusals[..6], ["", "unreadable", "", "unreadable", "", "unreadable"], "{}", run.out);
    for header in ["vehicle.1.heading []", "vehicle.1.speed [ ]"] {
        let run = run_with_input(&["batch", "-", "-o", "-", "--case", &case], &format!("{header}\n1\n"));
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{header}");
        assert!(run.err.contains("the unit is empty") && run.err.contains("leave it out if the numbers are in"), "{header}: {}", run.err);
    }
}

/// A column that is no input, beside one that is.
fn with_column(folder: &Folder, array: ArrayRef) -> String {
    let speeds: ArrayRef = Arc::new(Float64Array::from(vec![40.0; array.len()]));
    let table = RecordBatch::try_from_iter_with_nullable([("vehicle.1.speed", speeds, true), ("other", array, true)])
        .expect("columns of one length");
    let path = folder.path().join("in.arrow");
    let mut writer = FileWriter::try_new(fs::File::create(&path).expect("a file"), table.schema_ref()).expect("a writer");
    writer.write(&table).and_then(|()| writer.finish()).expect("a table");
    text(&path).to_owned()
}

#[test]
fn other_columns_pass_through_or_are_refused_by_name() {
    use arrow_array::builder::{FixedSizeBinaryBuilder, Int32Builder};
    use arrow_array::{StringViewArray, TimestampSecondArray, UnionArray};
    let folder = Folder::new();
    let solve = |array: ArrayRef, output: &str| {
        let input = with_column(&folder, array);
        let output = if output == "-" { output.to_owned() } else { text(&folder.path().join(output)).to_owned() };
        batch(&[&input, "-o", &output, "--case", POSITION_A, "--of", "e"])
    };
    // The instants of a named zone, in UTC.
    let times = TimestampSecondArray::from(vec![0, 1_700_000_000]);
    for zone in ["UTC", "Europe/Berlin"] {
        let done = solve(Arc::new(times.clone().with_timezone(zone)), "-");
        assert_eq!((done.status, done.err.as_str()), (0, ""), "{zone}");
        let column: Vec<String> = rows(&done.out).iter().skip(1).map(|row| row[1].clone()).collect();
        assert_eq!(column, ["1970-01-01T00:00:00Z", "2023-11-14T22:13:20Z"], "{zone}");
    }
    // What has no text is an error, and no text of its own.
    let done = solve(Arc::new(Date32Array::from(vec![i32::MAX])), "-");
    assert_eq!((done.status, done.out.as_str()), (74, ""), "{}", done.err);
    let numbers: ArrayRef = Arc::new(arrow_array::Int32Array::from(vec![1]));
    let field = Arc::new(arrow_schema::Field::new("a", arrow_schema::DataType::Int32, true));
    let fields: arrow_schema::UnionFields = [(0, field)].into_iter().collect();
    let union = UnionArray::try_new(fields, vec![0].into(), None, vec![numbers]).expect("a union");
    let mut nothing = FixedSizeBinaryBuilder::with_capacity(1, 0);
    nothing.append_value([]).expect("nothing");
    let mut keys = Int32Builder::new();
    keys.append_value(0);
    let views: ArrayRef = Arc::new(StringViewArray::from(vec!["a"]));
    let dictionary = arrow_array::DictionaryArray::<Int32Type>::try_new(keys.finish(), views).expect("a dictionary");
    for array in [Arc::new(union) as ArrayRef, Arc::new(nothing.finish()), Arc::new(dictionary)] {
        let kind = array.data_type().to_string();
        let done = solve(array, "out.parquet");
        assert_eq!((done.status, done.out.as_str()), (2, ""), "{kind}: {}", done.err);
        assert!(done.err.contains("error: other: its type is") && done.err.contains("leave the column out"), "{kind}: {}", done.err);
        assert!(!folder.path().join("out.parquet").exists(), "{kind}");
    }
}

/// A file of Arrow has one dictionary for each column, and the tables that are read may have two.
#[test]
fn dictionaries_of_several_tables_are_written_as_their_values() {
    let folder = Folder::new();
    let inputs: Vec<PathBuf> = [["x", "y"], ["p", "q"]]
        .into_iter()
        .enumerate()
        .map(|(i, words)| {
            let mut sites = StringDictionaryBuilder::<Int32Type>::new();
            words.into_iter().for_each(|site| sites.append_value(site));
            let speeds: ArrayRef = Arc::new(Float64Array::from(vec![10.0, 11.0]));
            let table =
                RecordBatch::try_from_iter([("vehicle.1.speed", speeds), ("site", Arc::new(sites.finish()) as ArrayRef)]).expect("a table");
            let path = folder.path().join(format!("{i}.arrow"));
            let mut writer = StreamWriter::try_new(fs::File::create(&path).expect("a file"), table.schema_ref()).expect("a writer");
            writer.write(&table).and_then(|()| writer.finish()).expect("a table");
            path
        })
        .collect();
    let output = folder.path().join("both.arrow");
    let done = batch(&[text(&inputs[0]), text(&inputs[1]), "-o", text(&output), "--case", POSITION_A, "--of", "W_n"]);
    assert_eq!(done.status, 0, "{}", done.err);
    let sites = read(&output).column(1).as_string::<i32>().iter().map(Option::unwrap_or_default).collect::<Vec<_>>().join("");
    assert_eq!(sites, "xypq");
    // Two streams in one file: the rows of the second would be lost.
    let joined = inputs.iter().flat_map(|path| fs::read(path).expect("a table")).collect::<Vec<u8>>();
    let joined = folder.write("joined.arrow", &joined);
    let done = batch(&[text(&joined), "-o", "-", "--case", POSITION_A, "--of", "W_n"]);
    assert_eq!((done.status, done.out.as_str()), (2, ""));
    assert!(done.err.contains("bytes follow the end of its stream"), "{}", done.err);
}

/// A bit of a page of Parquet that has a checksum: by `reference/page_checksum.py`.
#[test]
fn a_page_whose_checksum_is_wrong_is_refused() {
    let folder = Folder::new();
    let mut bytes = fs::read(workspace().join("cli/tests/reference/page_checksum.parquet")).expect("a table");
    let solve = |bytes: &[u8]| batch(&[text(&folder.write("in.parquet", bytes)), "-o", "-", "--case", POSITION_A, "--of", "W_n"]);
    assert_eq!(solve(&bytes).status, 0);
    let at = bytes.windows(8).position(|eight| eight == 11_f64.to_le_bytes()).expect("its value");
    bytes[at + 6] ^= 4;
    let done = solve(&bytes);
    assert_eq!((done.status, done.out.as_str()), (2, ""), "{}", done.err);
    assert!(done.err.contains("checksum"), "{}", done.err);
}

#[test]
fn digits_of_a_decimal_are_rounded_once() {
    let folder = Folder::new();
    let digits = "40100123456789123456789123456789123456";
    let value: i128 = digits.parse().expect("digits");
    let column = arrow_array::Decimal128Array::from(vec![value]).with_precision_and_scale(38, 36).expect("38 digits");
    let table = RecordBatch::try_from_iter([("vehicle.1.speed", Arc::new(column) as ArrayRef)]).expect("a table");
    let path = folder.path().join("in.arrow");
    let mut writer = FileWriter::try_new(fs::File::create(&path).expect("a file"), table.schema_ref()).expect("a writer");
    writer.write(&table).and_then(|()| writer.finish()).expect("a table");
    let of_decimal = batch(&[text(&path), "-o", "-", "--case", POSITION_A, "--of", "W_n"]);
    let csv = folder.write("in.csv", format!("vehicle.1.speed\n{}.{}\n", &digits[..2], &digits[2..]).as_bytes());
    let of_text = batch(&[text(&csv), "-o", "-", "--case", POSITION_A, "--of", "W_n"]);
    assert_eq!((of_decimal.status, of_text.status), (0, 0), "{}", of_decimal.err);
    assert_eq!(rows(&of_decimal.out)[1][1], rows(&of_text.out)[1][1]);
}

/// More tables than a process may have open, and threads of which there is none, because no memory holds their stacks.
#[test]
fn many_tables_and_threads() {
    let folder = Folder::new();
    let inputs: Vec<String> = (0..60)
        .map(|i| text(&folder.write(&format!("{i}.csv"), format!("contact.restitution\n0.{i:02}\n").as_bytes())).to_owned())
        .collect();
    let program = env!("CARGO_BIN_EXE_planar-impact");
    let call = |limit: &str, threads: &str| {
        let words = format!("{limit}; exec \"$0\" batch \"$@\" -o - --case {POSITION_A} --of e --threads {threads}");
        std::process::Command::new("sh").args(["-c", &words, program]).args(&inputs).current_dir(workspace()).output().expect("a shell")
    };
    for (limit, threads) in [("ulimit -n 40", "2"), ("export RUST_MIN_STACK=70368744177664", "1024")] {
        let done = call(limit, threads);
        assert_eq!(done.status.code(), Some(0), "{limit}: {}", String::from_utf8_lossy(&done.stderr));
        let out = String::from_utf8(done.stdout).expect("text");
        assert!(rows(&out).iter().skip(1).enumerate().all(|(i, row)| row[0] == format!("0.{i:02}")) && out.lines().count() == 61, "{out}");
    }
}
