//! A drawing as its groups, which can be taken apart and put together.

/// A group code and its value, as they are written.
pub type Group = (String, String);

/// The groups of a text; what is no pair of lines ends it.
pub fn groups(text: &str) -> Vec<Group> {
    let lines: Vec<&str> = text.lines().collect();
    lines.chunks_exact(2).map(|pair| (pair[0].trim().to_owned(), pair[1].trim().to_owned())).collect()
}

/// The text of groups.
pub fn text(groups: &[Group]) -> String {
    groups.iter().map(|(code, value)| format!("{code}\n{value}\n")).collect()
}

/// Where the records (entities, sections, marks) begin and end: every group 0 begins one.
pub fn records(groups: &[Group]) -> Vec<std::ops::Range<usize>> {
    let mut starts: Vec<usize> = (0..groups.len()).filter(|&i| groups[i].0 == "0").collect();
    starts.push(groups.len());
    starts.windows(2).map(|w| w[0]..w[1]).collect()
}

/// Whether a group holds a coordinate, a length, an angle or a bulge of an entity.
pub fn is_measure((code, value): &Group) -> bool {
    let measure = matches!(code.parse(), Ok(10..=18 | 20..=28 | 40..=51));
    measure && value.parse::<f64>().is_ok_and(f64::is_finite)
}

/// The groups as a binary file, with codes of two bytes. Values that are no numbers become 0.
pub fn binary(groups: &[Group]) -> Vec<u8> {
    let mut bytes = b"AutoCAD Binary DXF\r\n\x1A\0".to_vec();
    for (code, value) in groups {
        let code: u16 = code.parse().unwrap_or_default();
        let real: f64 = value.parse().unwrap_or_default();
        bytes.extend(code.to_le_bytes());
        match code {
            10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => bytes.extend(real.to_le_bytes()),
            60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => {
                bytes.extend((real as i16).to_le_bytes());
            }
            90..=99 | 420..=429 | 440..=459 | 1071 => bytes.extend((real as i32).to_le_bytes()),
            160..=169 => bytes.extend((real as i64).to_le_bytes()),
            290..=299 => bytes.push(real as u8),
            _ => bytes.extend(value.bytes().filter(|&b| b != 0).chain([0])),
        }
    }
    bytes
}
