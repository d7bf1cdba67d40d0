package io.furrow.simulators.device;

import java.time.Instant;
import java.util.Base64;
import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.Position;
import io.furrow.simulators.camera.FieldPicture;
import io.furrow.simulators.camera.View;

import static org.assertj.core.api.Assertions.assertThat;

class CameraTest {
    private static final Position PLACE = new Position(40.3, -3.48);
    private static final Instant TIME = Instant.parse("2026-06-01T12:00:00Z");

    @Test
    void sendsItsPictureAsBase64() {
        String text = new Camera("camera-1").measure(TIME, PLACE).textValue();

        assertThat(Base64.getDecoder().decode(text))
                .isEqualTo(FieldPicture.png(new View("camera-1", TIME, PLACE, 0, "", List.of())));
    }
}
