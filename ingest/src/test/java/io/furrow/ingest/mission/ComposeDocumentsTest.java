package io.furrow.ingest.mission;

import java.util.List;
import java.util.stream.Stream;

import org.apache.flink.streaming.api.operators.ProcessOperator;
import org.apache.flink.streaming.util.OneInputStreamOperatorTestHarness;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.DeadLetter;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.params.provider.Arguments.arguments;

class ComposeDocumentsTest {
    private static final String FEW_BYTES_OF_JSON_MANY_OF_BSON = "0,".repeat(1_500_000) + "0";

    @AutoClose
    private OneInputStreamOperatorTestHarness<MissionEvent, MissionDocument> harness;

    @BeforeEach
    void open() throws Exception {
        harness = new OneInputStreamOperatorTestHarness<>(new ProcessOperator<>(new ComposeDocuments()));
        harness.open();
    }

    static Stream<Arguments> whatNoDocumentCanHold() {
        return Stream.of(
                arguments("{\"id\":\"a\",\"n\":{\"value\":" + "1".repeat(35) + "}}", "refused", "35 digits"),
                arguments("{\"id\":\"a\",\"n\":{\"value\":0." + "3".repeat(35) + "}}", "refused", "35 digits"),
                arguments("{\"id\":\"a\",\"n\":{\"value\":1e1001}}", "too-deep", "exponent"),
                arguments("{\"id\":\"a\",\"n\":{\"value\":" + "[".repeat(70) + "]".repeat(70) + "}}", "too-deep", "64"),
                arguments("{\"id\":\"a\",\"n\":{\"value\":\"\\ud800\"}}", "not-an-entity", "surrogate"),
                arguments(
                        "{\"id\":\"a\",\"n\":{\"value\":[" + FEW_BYTES_OF_JSON_MANY_OF_BSON + "]}}",
                        "too-large",
                        "16 MiB"),
                arguments("{\"id\":\"a\",", "not-json", ""),
                arguments("[]", "not-an-entity", ""));
    }

    @ParameterizedTest(name = "{1} {2}") // the JSON may have megabytes
    @MethodSource("whatNoDocumentCanHold")
    void setsAsideWhatNoDocumentCanHold(String json, String reason, String message) throws Exception {
        harness.processElement(Events.event("m", "bad", Events.TIME, json), Events.TIME);
        harness.processElement(Events.reading("m", 1), Events.TIME);

        assertThat(harness.extractOutputValues())
                .extracting(MissionDocument::id)
                .containsExactly("event-1");
        assertThat(harness.getSideOutput(DeadLetters.TAG)).singleElement().satisfies(record -> {
            TopicRecord dead = record.getValue();
            assertThat(dead.topic()).isEqualTo("data.raw.dead");
            assertThat(dead.headers())
                    .containsEntry(DeadLetter.REASON, reason)
                    .containsEntry(DeadLetter.STAGE, "missions")
                    .containsEntry(DeadLetter.SOURCE, "data.raw-0@7");
            assertThat(dead.headers().get(DeadLetter.MESSAGE)).contains(message);
        });
    }

    @Test
    void encodesAMissionsNameAsTopicsDo() throws Exception {
        for (String mission : List.of("weeding", "field.7", "a$b", "dead")) {
            harness.processElement(Events.reading(mission, 1), Events.TIME);
        }

        assertThat(harness.extractOutputValues())
                .extracting(MissionDocument::collection)
                .containsExactly("mission_weeding", "mission__x-field-2E7", "mission__x-a-24b", "mission__x-dead");
    }

    @Test
    void makesNoDocumentOfAnEventWithoutAMission() throws Exception {
        harness.processElement(Events.reading("", 1), Events.TIME);
        harness.processElement(Events.reading("m", 2), Events.TIME);

        assertThat(harness.extractOutputValues())
                .extracting(MissionDocument::id)
                .containsExactly("event-2");
    }

    @Test
    void keepsADeletionByTheKeyOfItsRecord() throws Exception {
        harness.processElement(Events.event("m", "gone", Events.TIME, null), Events.TIME);

        assertThat(harness.extractOutputValues())
                .singleElement()
                .satisfies(document -> assertThat(new org.bson.RawBsonDocument(document.bson()).toJson())
                        .contains("\"id\": \"t1\", \"_deleted\": true"));
    }
}
