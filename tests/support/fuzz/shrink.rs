//! Makes a file that shows a fault small.

use super::drawing::{Group, groups, records, text};

/// The smallest file found, by leaving out and rounding, that is still `bad`.
pub fn shrink(bytes: &[u8], bad: &dyn Fn(&[u8]) -> bool) -> Vec<u8> {
    let Ok(whole) = std::str::from_utf8(bytes) else { return bytes.to_vec() };
    let still = |groups: &[Group]| bad(text(groups).as_bytes());
    let mut kept = groups(whole);
    if !still(&kept) {
        return bytes.to_vec();
    }
    loop {
        let before = kept.clone();
        leave_out_records(&mut kept, &still);
        leave_out_groups(&mut kept, &still);
        round(&mut kept, &still);
        if kept == before {
            return text(&kept).into_bytes();
        }
    }
}

fn leave_out_records(kept: &mut Vec<Group>, still: &dyn Fn(&[Group]) -> bool) {
    for i in (0..records(kept).len()).rev() {
        let mut fewer = kept.clone();
        fewer.drain(records(kept)[i].clone());
        if still(&fewer) {
            *kept = fewer;
        }
    }
}

fn leave_out_groups(kept: &mut Vec<Group>, still: &dyn Fn(&[Group]) -> bool) {
    // A vertex is two groups, or three with its bulge.
    for count in [3, 2, 1] {
        let mut i = kept.len();
        while i > 0 {
            i -= 1;
            if i + count > kept.len() {
                continue;
            }
            let mut fewer = kept.clone();
            fewer.drain(i..i + count);
            if still(&fewer) {
                *kept = fewer;
            }
        }
    }
}

fn round(kept: &mut [Group], still: &dyn Fn(&[Group]) -> bool) {
    for i in 0..kept.len() {
        let Ok(value) = kept[i].1.parse::<f64>() else { continue };
        for digits in [0, 1, 2, 4, 6, 9, 12] {
            let shorter = format!("{value:.digits$}");
            if shorter.len() >= kept[i].1.len() {
                break;
            }
            let old = std::mem::replace(&mut kept[i].1, shorter);
            if still(kept) {
                break;
            }
            kept[i].1 = old;
        }
    }
}
