package io.furrow.ingest.image;

import java.util.Arrays;
import java.util.Base64;
import java.util.Random;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvFileSource;

import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.US_ASCII;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ImageDecoderTest {
    @ParameterizedTest(name = "{0}")
    @CsvFileSource(resources = "/image/texts.csv", delimiter = '|', numLinesToSkip = 1)
    void readsEveryFormOfBase64(String form, String text, String expected) throws Exception {
        byte[] decoded = ImageDecoder.decode(unescaped(text));

        assertThat(java.util.HexFormat.of().formatHex(decoded)).isEqualTo(expected == null ? "" : expected);
    }

    @ParameterizedTest(name = "{0}")
    @CsvFileSource(resources = "/image/broken-texts.csv", delimiter = '|', numLinesToSkip = 1)
    void saysWhatIsWrongWithATextThatIsNone(String what, String text, String message) {
        assertThatThrownBy(() -> ImageDecoder.decode(unescaped(text)))
                .isInstanceOf(UnreadableException.class)
                .hasMessageContaining(message)
                .satisfies(e -> assertThat(((UnreadableException) e).reason()).isEqualTo(Reason.NOT_AN_IMAGE));
    }

    @Test
    void readsWhatAnEncoderWroteWhateverItsLength() throws Exception {
        Random random = new Random(11);
        for (int length = 0; length < 300; length++) {
            byte[] bytes = new byte[length];
            random.nextBytes(bytes);
            String standard = Base64.getEncoder().encodeToString(bytes);
            for (String text : new String[] {
                standard,
                Base64.getMimeEncoder().encodeToString(bytes),
                Base64.getUrlEncoder().withoutPadding().encodeToString(bytes),
                standard.replace("=", "%3D").replace("+", "%2b").replace("/", "%2F"),
                "data:image/png;base64," + standard
            }) {
                assertThat(ImageDecoder.decode(text.getBytes(US_ASCII)))
                        .as("%s", text)
                        .isEqualTo(bytes);
            }
        }
    }

    @Test
    void leavesTheTextUnharmed() throws Exception {
        byte[] text = "data:;base64,_-_-".getBytes(US_ASCII);
        byte[] before = Arrays.copyOf(text, text.length);

        ImageDecoder.decode(text);

        assertThat(text).isEqualTo(before);
    }

    private static byte[] unescaped(String text) {
        return text.replace("\\r", "\r")
                .replace("\\n", "\n")
                .replace("\\t", "\t")
                .getBytes(UTF_8);
    }
}
