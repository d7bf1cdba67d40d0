package io.furrow.ingest.image;

import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ImageTest {
    /** No text is known that does this; none stands for it. */
    @Test
    void isUnreadableIfADecoderFails() {
        assertThatThrownBy(() -> Image.of(null, 10))
                .isInstanceOf(UnreadableException.class)
                .hasMessageContaining("cannot be decoded")
                .hasCauseInstanceOf(NullPointerException.class)
                .satisfies(e -> assertThat(((UnreadableException) e).reason()).isEqualTo(Reason.NOT_AN_IMAGE));
    }
}
