package io.furrow.launcher;

import java.io.ByteArrayOutputStream;
import java.nio.charset.Charset;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

class AsciiWriterTest {
    @ParameterizedTest
    @CsvSource({
        "US-ASCII, x - y 2 -> 3 (-1) ..., ?",
        "ISO-8859-1, x - y 2 -> 3 (-1) ..., ü",
        "UTF-8, x – y 2 → 3 (−1) …, ü"
    })
    void writesSignsThatTheEncodingHas(String encoding, String line, String letter) {
        ByteArrayOutputStream out = new ByteArrayOutputStream();
        Charset charset = Charset.forName(encoding);

        AsciiWriter.to(out, charset).printf("x – y 2 → 3 (−1) …, %s%n", "ü").flush();

        assertThat(out.toString(charset)).isEqualTo("%s, %s%n", line, letter);
    }
}
