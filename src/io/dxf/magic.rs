//! Files that are no DXF.

/// What a file is that is no DXF, as far as its first bytes tell, and what to do.
pub(super) fn other_format(bytes: &[u8]) -> Option<&'static str> {
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
    let begins = |with: &[u8]| text.len() >= with.len() && text[..with.len()].eq_ignore_ascii_case(with);
    if text.is_empty() {
        return Some("the file is empty");
    }
    if begins(b"AC10") || begins(b"AC1.") || begins(b"AC2.") || begins(b"AC40") {
        return Some(
            "it is a DWG; save it as DXF in the drawing program, or convert it with LibreDWG: dwg2dxf",
        );
    }
    if begins(b"\xFF\xFE") || begins(b"\xFE\xFF") {
        return Some("it is UTF-16 text; save it as UTF-8 or ANSI");
    }
    if begins(b"AutoCAD DXB") {
        return Some("it is a DXB; save it as DXF in the drawing program");
    }
    if begins(b"<") {
        return Some("it is XML, perhaps an SVG; save it as DXF in the drawing program");
    }
    if begins(b"%PDF") {
        return Some("it is a PDF; save the drawing in it as DXF");
    }
    if begins(b"PK\x03\x04") || begins(b"\x1F\x8B") || begins(b"7z\xBC\xAF") || begins(b"Rar!") {
        return Some("it is an archive; unpack the drawing in it");
    }
    if begins(b"%!PS") {
        return Some("it is PostScript; save the drawing in it as DXF");
    }
    if begins(b"ISO-10303-21") {
        return Some("it is a STEP model; save a face or section of it as DXF");
    }
    if begins(b"\x89PNG") || begins(b"\xFF\xD8\xFF") || begins(b"GIF8") || begins(b"BM") {
        return Some("it is a picture of pixels; trace its outlines and save them as DXF");
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_known_by_their_first_bytes() {
        for (bytes, word) in [
            (&b""[..], "empty"),
            (b"\r\n ", "empty"),
            (b"AC1027\0\0", "DWG"),
            (b"\xFF\xFE0\0", "UTF-16"),
            (b"\xEF\xBB\xBF<svg>", "SVG"),
            (b"%PDF-1.7", "PDF"),
            (b"PK\x03\x04", "archive"),
            (b"\x1F\x8B\x08", "archive"),
            (b"\x89PNG\r\n", "pixels"),
            (b"ISO-10303-21;", "STEP"),
        ] {
            assert!(other_format(bytes).is_some_and(|reason| reason.contains(word)), "{word}");
        }
        assert_eq!(other_format(b"  0\nSECTION"), None);
    }
}
