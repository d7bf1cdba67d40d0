package io.furrow.ingest.mission;

import java.io.IOException;
import java.time.Clock;
import java.time.Duration;
import java.util.List;
import java.util.stream.IntStream;
import java.util.stream.Stream;

import com.mongodb.client.MongoClient;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.mission.bulk.BulkSender;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.Retention;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** What becomes of documents that the server does not take, by its code. */
@Tag("full")
class RefusalsTest {
    private static final int FOR_EVER = Integer.MAX_VALUE;
    private static final int FEW = 4;
    private static final Duration LONG = Duration.ofMinutes(1);
    private static final Duration SHORT = Duration.ofMillis(200);

    private FaultyMongo mongo;
    private MongoClient client;
    private MissionCollections collections;

    @BeforeEach
    void start() {
        mongo = new FaultyMongo();
        client = new MongoAccess(mongo.uri(), MongoAccess.Waits.of(LONG)).open();
        collections = new MissionCollections(client, Retention.FOR_EVER, Clock.systemUTC());
    }

    @AfterEach
    void stop() {
        client.close();
        mongo.stop();
    }

    @ParameterizedTest
    @ValueSource(ints = {365, 16500, 13388, 150, 133, 314, 8, 1, 777_777})
    void waitForWhatPasses(int code) throws Exception {
        mongo.refuse("event-3", code, FEW);

        assertThat(sender(LONG).send(documents(10))).isEmpty();
        assertThat(count()).isEqualTo(10);
    }

    @ParameterizedTest
    @ValueSource(ints = {365, 16500, 13388, 8, 1, 777_777})
    void waitForWhatPassesForAWholeBulk(int code) throws Exception {
        mongo.failWrites(code, FEW);

        assertThat(sender(LONG).send(documents(10))).isEmpty();
        assertThat(count()).isEqualTo(10);
    }

    @ParameterizedTest
    @ValueSource(ints = {2, 9, 14, 121, 10334, 17280, 16755})
    void areGivenBackAtOnceWhereTheCodeSaysThatTheDocumentIsAtFault(int code) throws Exception {
        mongo.refuse("event-3", code, FOR_EVER);

        assertThat(sender(LONG).send(documents(10)))
                .singleElement()
                .satisfies(refusal -> assertThat(refusal.document().id()).isEqualTo("event-3"));
        assertThat(mongo.attempts()).isEqualTo(1);
        assertThat(count()).isEqualTo(9);
    }

    @Test
    void giveUpADocumentWhoseCodeSaysNothingWhenItWasTriedForLong() throws Exception {
        mongo.refuse("event-3", 777_777, FOR_EVER);

        assertThat(sender(SHORT).send(documents(10))).singleElement().satisfies(refusal -> {
            assertThat(refusal.document().id()).isEqualTo("event-3");
            assertThat(refusal.reason()).contains("777777");
        });
        assertThat(mongo.attempts()).isGreaterThan(2);
        assertThat(count()).isEqualTo(9);
    }

    @Test
    void areFewAttemptsWhereTheCodeWasMetBeforeWhileOthersPassed() throws Exception {
        BulkSender<MissionDocument> sender = sender(SHORT);
        mongo.refuse("event-3", 777_777, FOR_EVER);
        mongo.refuse("event-13", 777_777, FOR_EVER);
        sender.send(documents(10));
        int before = mongo.attempts();

        assertThat(sender.send(documents(10, 20))).hasSize(1);
        assertThat(mongo.attempts() - before).isEqualTo(3);
        assertThat(count()).isEqualTo(18);
    }

    @Test
    void areAllOfABulkWhereTheirCodeWasMetBeforeWhileOthersPassed() throws Exception {
        BulkSender<MissionDocument> sender = sender(SHORT);
        IntStream.range(9, 15).forEach(number -> mongo.refuse("event-" + number, 777_777, FOR_EVER));
        sender.send(documents(10));

        assertThat(sender.send(documents(10, 15))).hasSize(5);
    }

    @Test
    void areNoneWhereNothingPasses() {
        IntStream.range(0, 10).forEach(number -> mongo.refuse("event-" + number, 777_777, FOR_EVER));

        assertThatThrownBy(() -> sender(SHORT).send(documents(10)))
                .isInstanceOf(IOException.class)
                .hasMessageContainingAll(
                        "took none of 10 documents of mission_m", "[777777]", "--mongo-refusal-timeout");
    }

    @Test
    void areNoneWhereEachWriteFailsAsAWhole() {
        mongo.failWrites(777_777, FOR_EVER);

        assertThatThrownBy(() -> sender(SHORT).send(documents(10)))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("took none of 10 documents");
    }

    @Test
    void areNoneWhereNoneIsTakenAndOneIsAtFault() {
        mongo.refuse("event-0", 121, FOR_EVER);
        IntStream.range(1, 10).forEach(number -> mongo.refuse("event-" + number, 8, FOR_EVER));

        assertThatThrownBy(() -> sender(SHORT).send(documents(10)))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("took none of 10 documents");
    }

    @ParameterizedTest
    @ValueSource(ints = {2, 9})
    void areNoneWhereTheCommandMayBeAtFault(int code) {
        mongo.failWrites(code, FOR_EVER);

        assertThatThrownBy(() -> sender(SHORT).send(documents(10)))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("took none of 10 documents");
    }

    @Test
    void areNoneWhereEveryMissionHasOneAndAllFail() {
        mongo.failWrites(777_777, FOR_EVER);
        List<MissionDocument> lone = Stream.of("a", "b", "c")
                .map(mission -> Events.document(mission, 1))
                .toList();

        assertThatThrownBy(() -> sender(SHORT).send(lone))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("took none of 3 documents of mission_a, mission_b, mission_c");
    }

    @Test
    void areOfTheDocumentWhereItIsAlone() throws Exception {
        mongo.refuse("event-3", 777_777, FOR_EVER);

        assertThat(sender(SHORT).send(documents(3, 4))).hasSize(1);
    }

    private BulkSender<MissionDocument> sender(Duration unknown) {
        return new BulkSender<>(collections, new MongoAccess.Waits(LONG, unknown), ignored -> {});
    }

    private long count() {
        return collections.get("mission_m").countDocuments();
    }

    private static List<MissionDocument> documents(int to) {
        return documents(0, to);
    }

    private static List<MissionDocument> documents(int from, int to) {
        return IntStream.range(from, to).mapToObj(n -> Events.document("m", n)).toList();
    }
}
