package io.furrow.simulators.device;

import java.awt.image.BufferedImage;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.time.Instant;
import java.util.Base64;
import javax.imageio.ImageIO;

import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.Position;

import static org.assertj.core.api.Assertions.assertThat;

class FieldPictureTest {
    private static final Position PLACE = new Position(40.3, -3.48);
    private static final Instant TIME = Instant.parse("2026-06-01T12:00:00Z");

    @Test
    void isAPngOfItsSize() throws IOException {
        byte[] png = FieldPicture.png("camera-1", TIME, PLACE);

        assertThat(png).startsWith(0x89, 'P', 'N', 'G').hasSizeBetween(1_000, 40_000);
        BufferedImage image = ImageIO.read(new ByteArrayInputStream(png));
        assertThat(image.getWidth()).isEqualTo(FieldPicture.WIDTH);
        assertThat(image.getHeight()).isEqualTo(FieldPicture.HEIGHT);
    }

    @Test
    void showsWhichCameraTookItWhenAndWhere() {
        byte[] png = FieldPicture.png("camera-1", TIME, PLACE);

        assertThat(FieldPicture.png("camera-1", TIME, PLACE)).isEqualTo(png);
        assertThat(FieldPicture.png("camera-2", TIME, PLACE)).isNotEqualTo(png);
        assertThat(FieldPicture.png("camera-1", TIME.plusSeconds(3600), PLACE)).isNotEqualTo(png);
        assertThat(FieldPicture.png("camera-1", TIME, new Position(40.4, -3.48)))
                .isNotEqualTo(png);
    }

    @Test
    void travelsAsBase64() throws IOException {
        String text = new Camera("camera-1").measure(TIME, PLACE).textValue();

        assertThat(Base64.getDecoder().decode(text)).isEqualTo(FieldPicture.png("camera-1", TIME, PLACE));
    }
}
