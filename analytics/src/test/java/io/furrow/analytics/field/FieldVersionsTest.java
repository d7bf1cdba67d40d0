package io.furrow.analytics.field;

import org.junit.jupiter.api.Test;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.position.Position;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class FieldVersionsTest {
    private static final String EAST = "[[[[30,50],[40,50],[40,60],[30,60],[30,50]]]]";
    private static final Position IN_THE_SQUARE = new Position(55, 15);
    private static final Position IN_THE_EAST = new Position(55, 35);

    private final FieldRecords topic = new FieldRecords();

    @Test
    void areAsOfTheTimeThatTheyAreAskedFor() throws Exception {
        topic.square("f", 100, "canary");
        topic.area("f", 200, "dairy", EAST);
        topic.end("f", 300);
        FieldVersions known = FieldVersions.read(topic.atStart());

        assertThat(known.covering(IN_THE_SQUARE, 99)).isEmpty();
        assertThat(known.covering(IN_THE_SQUARE, 100)).extracting(Field::domain).containsExactly("canary");
        assertThat(known.covering(IN_THE_SQUARE, 199)).hasSize(1);
        assertThat(known.covering(IN_THE_SQUARE, 200)).isEmpty();
        assertThat(known.covering(IN_THE_EAST, 199)).isEmpty();
        assertThat(known.covering(IN_THE_EAST, 200))
                .extracting(Field::validFrom)
                .containsExactly(200L);
        assertThat(known.covering(IN_THE_EAST, 299)).hasSize(1);
        assertThat(known.covering(IN_THE_EAST, 300)).isEmpty();
        assertThat(known.at("f", 99)).isEmpty();
        assertThat(known.at("f", 250)).map(Field::domain).contains("dairy");
        assertThat(known.at("f", 300)).isEmpty();
        assertThat(known.at("g", 300)).isEmpty();
    }

    @Test
    void comeAndChangeAndGoWhileTheJobRuns() throws Exception {
        FieldVersions known = FieldVersions.read(topic.atStart());
        assertThat(known.covering(IN_THE_SQUARE, 500)).isEmpty();

        assertThat(known.take(topic.square("f", 100, ""))).isTrue();
        assertThat(known.covering(IN_THE_SQUARE, 500)).hasSize(1);
        assertThat(known.take(topic.square("g", 100, ""))).isTrue();
        assertThat(known.covering(IN_THE_SQUARE, 500)).extracting(Field::id).containsExactlyInAnyOrder("f", "g");
        assertThat(known.take(topic.area("f", 400, "", EAST))).isTrue();
        assertThat(known.covering(IN_THE_SQUARE, 399)).hasSize(2);
        assertThat(known.covering(IN_THE_SQUARE, 500)).extracting(Field::id).containsExactly("g");
        assertThat(known.take(topic.end("g", 450))).isTrue();
        assertThat(known.covering(IN_THE_SQUARE, 500)).isEmpty();
    }

    @Test
    void areAsIfAVersionThatIsTakenAwayHadNeverBeen() throws Exception {
        topic.square("f", 100, "");
        topic.end("f", 300);
        FieldVersions known = FieldVersions.read(topic.atStart());
        assertThat(known.covering(IN_THE_SQUARE, 300)).isEmpty();

        known.take(topic.takeAway("f", 300));
        assertThat(known.covering(IN_THE_SQUARE, 300)).hasSize(1);
        known.take(topic.takeAway("f", 100));
        assertThat(known.covering(IN_THE_SQUARE, 300)).isEmpty();
    }

    @Test
    void holdWhatWasWrittenLastUnderAKey() throws Exception {
        topic.square("f", 100, "canary");
        topic.square("f", 100, "dairy");
        FieldVersions known = FieldVersions.read(topic.atStart());

        assertThat(known.at("f", 100)).map(Field::domain).contains("dairy");
    }

    @Test
    void passOverWhatTheStreamRepeatsOfTheStart() throws Exception {
        TopicRecord before = topic.square("f", 100, "");
        TopicRecord gone = topic.takeAway("f", 100);
        FieldVersions known = FieldVersions.read(topic.atStart());

        assertThat(known.take(before)).isFalse();
        assertThat(known.covering(IN_THE_SQUARE, 500)).isEmpty();
        assertThat(known.take(gone)).isFalse();
        assertThat(known.take(topic.square("f", 100, ""))).isTrue();
        assertThat(known.covering(IN_THE_SQUARE, 500)).hasSize(1);
    }

    @Test
    void sayWhenAnyFieldNextBeginsChangesOrEnds() throws Exception {
        topic.square("f", 100, "");
        topic.square("g", 200, "");
        topic.end("f", 300);
        FieldVersions known = FieldVersions.read(topic.atStart());

        assertThat(known.nextChange(0)).hasValue(100);
        assertThat(known.nextChange(100)).hasValue(200);
        assertThat(known.nextChange(200)).hasValue(300);
        assertThat(known.nextChange(300)).isEmpty();
        known.take(topic.takeAway("g", 200));
        assertThat(known.nextChange(100)).hasValue(300);
    }

    @Test
    void areNotHarmedByWhatIsNoField() throws Exception {
        topic.square("f", 100, "");
        topic.add("f@1970-01-01T00:00:00.200Z", "{}".getBytes(UTF_8));
        topic.add(null, null);
        FieldVersions known = FieldVersions.read(topic.atStart());

        assertThat(known.take(topic.add("nonsense", null))).isFalse();
        assertThat(known.covering(IN_THE_SQUARE, 500)).hasSize(1);
    }
}
