package io.furrow.model.event;

import java.util.Map;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.NullSource;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;

class OriginalReferenceTest {
    @Test
    void isReadFromItsHeaders() {
        OriginalReference originalReference = new OriginalReference("data.north-2.realtime", 3, 17, 2_097_152);

        assertThat(originalReference.headers())
                .containsAllEntriesOf(Map.of("original", "data.north-2.realtime-3@17", "original-bytes", "2097152"));
        assertThat(OriginalReference.of(
                        originalReference.headers().get(OriginalReference.POSITION),
                        originalReference.headers().get(OriginalReference.BYTES)))
                .contains(originalReference);
    }

    @ParameterizedTest
    @NullSource
    @ValueSource(strings = {"", "data.raw", "data.raw-0", "data.raw@1", "-0@1", "data.raw-0@9999999999999999999"})
    void isEmptyForAnInvalidHeader(String position) {
        assertThat(OriginalReference.of(position, "1")).isEmpty();
    }
}
