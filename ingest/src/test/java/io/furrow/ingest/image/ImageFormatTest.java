package io.furrow.ingest.image;

import java.util.Arrays;
import java.util.Base64;
import java.util.Random;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ImageFormatTest {
    private static final byte[] PNG = Pictures.png(1);
    private static final byte[] JPEG = Pictures.jpeg(1);

    @Test
    void tellsPngAndJpegByTheirBytes() throws Exception {
        assertThat(ImageFormat.of(PNG)).isEqualTo(ImageFormat.PNG);
        assertThat(ImageFormat.of(JPEG)).isEqualTo(ImageFormat.JPEG);
    }

    @Test
    void takesWhatACameraAddsBehindTheEnd() throws Exception {
        assertThat(ImageFormat.of(Arrays.copyOf(PNG, PNG.length + 100))).isEqualTo(ImageFormat.PNG);
        assertThat(ImageFormat.of(Arrays.copyOf(JPEG, JPEG.length + 100))).isEqualTo(ImageFormat.JPEG);
    }

    @Test
    void refusesAnImageThatIsCutOffAnywhere() {
        for (byte[] whole : new byte[][] {PNG, JPEG}) {
            for (int length = 0; length < whole.length; length++) {
                byte[] part = Arrays.copyOf(whole, length);
                assertThatThrownBy(() -> ImageFormat.of(part))
                        .as("%d of %d bytes", length, whole.length)
                        .isInstanceOf(UnreadableException.class);
            }
        }
    }

    @Test
    void refusesAPngWithAnyBitTurned() {
        for (int i = 0; i < PNG.length; i++) {
            byte[] damaged = PNG.clone();
            damaged[i] ^= (byte) (1 << i % 8);
            assertThatThrownBy(() -> ImageFormat.of(damaged)).as("byte %d", i).isInstanceOf(UnreadableException.class);
        }
    }

    /** Its checksum is right. */
    @ParameterizedTest
    @ValueSource(strings = {"iVBORw0KGgoAAAABSUhEUgFFeJer", "iVBORw0KGgoAAAAASUhEUqihrgo="})
    void refusesAPngWithAHeaderOfAnotherLength(String base64) {
        byte[] bytes = Base64.getDecoder().decode(base64);

        assertThatThrownBy(() -> ImageFormat.of(bytes))
                .isInstanceOf(UnreadableException.class)
                .hasMessageContaining("header");
    }

    @Test
    void neverFailsInAnotherWayWhateverTheBytes() {
        Random random = new Random(5);
        int refused = 0;
        for (int i = 0; i < 20_000; i++) {
            byte[] bytes = (i % 2 == 0 ? PNG : JPEG).clone();
            for (int j = 0; j < 4; j++) {
                bytes[random.nextInt(Math.min(bytes.length, 200))] = (byte) random.nextInt();
            }
            try {
                ImageFormat.of(bytes);
            } catch (UnreadableException e) {
                refused++;
            }
        }
        assertThat(refused).isPositive();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
                    nothing          |                                  | neither PNG nor JPEG
                    a GIF            | 474946383961010001000000003b     | neither PNG nor JPEG
                    a WebP           | 52494646240000005745425056503820 | neither PNG nor JPEG
                    a signature only | 89504e470d0a1a0a                 | the PNG is cut off
                    a start only     | ffd8ffe0                         | the JPEG is cut off
                    start and end    | ffd8ffd9                         | the JPEG has no pixels
                    no marker        | ffd8ffe00002aabbccdd             | something else where a marker should be
                    a scan, no frame | ffd8ffda00020000ffd9             | the JPEG has no frame header
                    """)
    void saysWhatItIsNot(String what, String hex, String message) {
        byte[] bytes = java.util.HexFormat.of().parseHex(hex == null ? "" : hex);

        assertThatThrownBy(() -> ImageFormat.of(bytes))
                .isInstanceOf(UnreadableException.class)
                .hasMessageContaining(message)
                .satisfies(e -> assertThat(((UnreadableException) e).reason()).isEqualTo(Reason.NOT_AN_IMAGE));
    }
}
