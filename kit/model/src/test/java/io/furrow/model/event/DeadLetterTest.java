package io.furrow.model.event;

import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.Reason;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.entry;

class DeadLetterTest {
    @Test
    void describesReasonStageAndSource() {
        assertThat(new DeadLetter(Reason.NOT_AN_ENTITY, "no id", "ingest", "data.raw-0@7").headers())
                .containsExactly(
                        entry("dead-reason", "not-an-entity"),
                        entry("dead-message", "no id"),
                        entry("dead-stage", "ingest"),
                        entry("dead-source", "data.raw-0@7"));
    }

    @Test
    void truncatesLongMessages() {
        DeadLetter letter = new DeadLetter(Reason.NOT_AN_ENTITY, "attribute '" + "x".repeat(8_000_000), "ingest", "");

        assertThat(letter.message()).hasSize(500).startsWith("attribute 'xxx").endsWith("…");
    }

    @Test
    void usesTheReasonWithoutAMessage() {
        assertThat(new DeadLetter(Reason.REFUSED, null, "sink", "").headers()).containsEntry("dead-message", "refused");
    }

    @Test
    void replacesHalvesOfSurrogatePairs() {
        String cut = "x".repeat(498) + "\ud83d\ude9c and more";

        assertThat(new DeadLetter(Reason.NOT_JSON, "a\ud83db", "stage", "s\udc00")
                        .headers()
                        .values())
                .contains("a\ufffdb", "s\ufffd");
        assertThat(new DeadLetter(Reason.NOT_JSON, cut, "stage", "s").message()).isEqualTo("x".repeat(498) + "\ufffd…");
    }
}
