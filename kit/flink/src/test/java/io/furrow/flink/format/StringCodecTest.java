package io.furrow.flink.format;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputDeserializer;
import org.apache.flink.core.memory.DataOutputSerializer;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;

class StringCodecTest {
    @ParameterizedTest
    @ValueSource(strings = {"", "data.raw", "é", "urn:ngsi-ld:Robot:\u8349"})
    void readsWhatWasWritten(String text) throws IOException {
        assertThat(copied(text)).isEqualTo(text);
        assertThat(copied(text.repeat(300))).isEqualTo(text.repeat(300));
    }

    @Test
    void readsEqualTextsAsOneObject() throws IOException {
        assertThat(copied("urn:ngsi-ld:Robot:17")).isSameAs(copied("urn:ngsi-ld:Robot:17"));
    }

    /** Both have one hash code, and so one place in the table of what is known. */
    @Test
    void tellsTextsOfOneHashCodeApart() throws IOException {
        assertThat(copied("Aa")).isEqualTo("Aa");
        assertThat(copied("BB")).isEqualTo("BB");
        assertThat(copied("Aa")).isEqualTo("Aa");
    }

    private static String copied(String text) throws IOException {
        DataOutputSerializer out = new DataOutputSerializer(16);
        StringCodec.write(text, out);
        return StringCodec.read(new DataInputDeserializer(out.getCopyOfBuffer()));
    }
}
