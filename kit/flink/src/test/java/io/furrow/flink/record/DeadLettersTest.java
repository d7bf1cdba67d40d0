package io.furrow.flink.record;

import java.util.Map;

import org.junit.jupiter.api.Test;

import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.OriginalReference;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class DeadLettersTest {
    private static final UnreadableException WHY = new UnreadableException(Reason.NOT_JSON, "why");

    @Test
    void keepTheWholeOfWhatIsNotLarge() {
        TopicRecord letter = DeadLetters.of(record(LargeRecords.LARGE, 17), WHY, "ingest");

        assertThat(letter.value()).hasSize(LargeRecords.LARGE);
        assertThat(letter.headers()).containsEntry(DeadLetter.SOURCE, "data.raw-3@17");
        assertThat(letter.headers().keySet()).doesNotContainAnyElementsOf(OriginalReference.HEADERS);
    }

    @Test
    void keepTheBeginningOfWhatIsLargeAndSayWhereTheRestIs() {
        TopicRecord letter = DeadLetters.of(record(LargeRecords.LARGE + 1, 17), WHY, "ingest");

        assertThat(letter.topic()).isEqualTo("data.raw.dead");
        assertThat(letter.key()).isEqualTo(new byte[] {'k'});
        assertThat(letter.timestamp()).isEqualTo(5);
        assertThat(letter.value()).hasSize(LargeRecords.BEGINNING).startsWith('b', 'e', 'g', 'u', 'n');
        assertThat(letter.headers())
                .containsEntry("ce_id", "7f")
                .containsEntry(DeadLetter.REASON, "not-json")
                .containsEntry(OriginalReference.POSITION, "data.raw-3@17")
                .containsEntry(OriginalReference.BYTES, Integer.toString(LargeRecords.LARGE + 1));
    }

    @Test
    void keepTheWholeOfWhatIsOnNoTopic() {
        TopicRecord letter = DeadLetters.of(record(LargeRecords.LARGE + 1, -1), WHY, "ingest");

        assertThat(letter.value()).hasSize(LargeRecords.LARGE + 1);
    }

    private static TopicRecord record(int bytes, long offset) {
        byte[] value = new byte[bytes];
        System.arraycopy("begun".getBytes(UTF_8), 0, value, 0, 5);
        return new TopicRecord("data.raw", 3, offset, 5, new byte[] {'k'}, value, Map.of("ce_id", "7f"));
    }
}
