package io.furrow.connect.source.journal;

import java.time.Instant;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.Map;

import org.junit.jupiter.api.Test;

import io.furrow.connect.record.KafkaRecord;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class JournalRecordCodecTest {
    private static final KafkaRecord FULL = new KafkaRecord(
            "data.raw", "urn:ä", new byte[] {1, 2, 3}, Instant.ofEpochMilli(1_700_000_000_123L), headers());

    private static Map<String, String> headers() {
        Map<String, String> headers = new LinkedHashMap<>();
        headers.put("z", "last letter first");
        headers.put("a", "");
        return headers;
    }

    @Test
    void readsWhatItWrote() {
        assertThat(JournalRecordCodec.read(JournalRecordCodec.write(FULL)))
                .usingRecursiveComparison()
                .isEqualTo(FULL);
        assertThat(JournalRecordCodec.read(JournalRecordCodec.write(FULL))
                        .headers()
                        .keySet())
                .containsExactly("z", "a");

        KafkaRecord bare = new KafkaRecord("t", null, null, Instant.EPOCH, Map.of());
        assertThat(JournalRecordCodec.read(JournalRecordCodec.write(bare)))
                .usingRecursiveComparison()
                .isEqualTo(bare);
    }

    @Test
    void hasTheBytesOfVersionOne() {
        KafkaRecord record = new KafkaRecord("t", "k", new byte[] {7}, Instant.ofEpochMilli(2), Map.of("h", "v"));
        assertThat(JournalRecordCodec.write(record))
                .containsExactly(
                        1, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 1, 't', 0, 0, 0, 1, 'k', 0, 0, 0, 1, 0, 0, 0, 1, 'h', 0, 0,
                        0, 1, 'v', 0, 0, 0, 1, 7);
    }

    @Test
    void refusesOtherVersionsAndOtherLengths() {
        byte[] bytes = JournalRecordCodec.write(FULL);
        byte[] newer = bytes.clone();
        newer[0] = 2;
        assertThatThrownBy(() -> JournalRecordCodec.read(newer))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("version 2");
        for (int length = 0; length < bytes.length; length++) {
            byte[] cut = Arrays.copyOf(bytes, length);
            assertThatThrownBy(() -> JournalRecordCodec.read(cut)).isInstanceOf(IllegalArgumentException.class);
        }
        assertThatThrownBy(() -> JournalRecordCodec.read(Arrays.copyOf(bytes, bytes.length + 1)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("too many");
    }

    @Test
    void refusesAHeaderWithoutANameOrAValue() {
        KafkaRecord record = new KafkaRecord("t", null, null, Instant.EPOCH, Map.of("", ""));
        for (int fromEnd : new int[] {12, 8}) {
            byte[] bytes = JournalRecordCodec.write(record);
            Arrays.fill(bytes, bytes.length - fromEnd, bytes.length - fromEnd + 4, (byte) -1);
            assertThatThrownBy(() -> JournalRecordCodec.read(bytes))
                    .isInstanceOf(IllegalArgumentException.class)
                    .hasMessageContaining("null");
        }
    }
}
