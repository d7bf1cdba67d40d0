package io.furrow.cli.option;

import java.net.URI;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;
import picocli.CommandLine.TypeConversionException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class HttpUriConverterTest {
    private final HttpUriConverter converter = new HttpUriConverter();

    @ParameterizedTest
    @ValueSource(
            strings = {
                "http://127.0.0.1:8080",
                "https://hooks.example.com/x?y=z",
                "HTTPS://example.com",
                "http://[::1]:80/x",
                "http://host:65535/"
            })
    void takesAbsoluteUrlsOfHttp(String text) {
        assertThat(converter.convert(text)).isEqualTo(URI.create(text));
    }

    @ParameterizedTest
    @CsvSource({
        "hooks.example.com/x, it has no scheme",
        "/x, it has no scheme",
        "'', it has no scheme",
        "localhost:4041, 'its scheme is ''localhost'', not http or https'",
        "ftp://example.com/x, 'its scheme is ''ftp'', not http or https'",
        "file:///etc/passwd, 'its scheme is ''file'', not http or https'",
        "http:/x, it has no host",
        "http:x, it has no host",
        "http:///x, it has no host",
        "http://under_score/x, it has no host",
        "http://a b/x, it is not a URI",
        "https://, it is not a URI",
        "http://host:99999/, there is no port 99999"
    })
    void rejectsAllElseAndReportsWhy(String text, String reason) {
        assertThatThrownBy(() -> converter.convert(text))
                .isInstanceOf(TypeConversionException.class)
                .hasMessageContainingAll("'" + text + "'", reason, "https://example.com/path");
    }

    @Test
    void doesNotRepeatAPassword() {
        assertThatThrownBy(() -> converter.convert("https://ann:secret@example.com/x"))
                .isInstanceOf(TypeConversionException.class)
                .hasMessageContaining("would not be sent")
                .hasMessageNotContaining("secret");
    }
}
