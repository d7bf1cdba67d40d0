package io.furrow.analytics.coverage;

import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.analytics.position.PositionFix;

import static org.assertj.core.api.Assertions.assertThat;

class SwathTest {
    private static final FieldRef FIELD = new FieldRef("f", 1, "", "");

    /** A coverage each: of a tenant, service path, mission, field, version of a field, and robot; in a replay another. */
    @Test
    void belongsToOneCoverage() {
        List<Swath> swaths = List.of(
                swath("data.raw", "farm|/|Robot|r", "m", FIELD, false),
                swath("data.raw", "farm|/|Robot|r", "m", FIELD, true),
                swath("data.raw", "farm|/|Robot|s", "m", FIELD, true),
                swath("data.raw", "farm|/|Tractor|r", "m", FIELD, true),
                swath("data.raw", "other|/|Robot|r", "m", FIELD, false),
                swath("data.raw", "farm|/north|Robot|r", "m", FIELD, false),
                swath("data.raw", "farm|/|Robot|r", "n", FIELD, false),
                swath("data.raw", "farm|/|Robot|r", "", FIELD, false),
                swath("data.raw", "farm|/|Robot|r", "m", new FieldRef("g", 1, "", ""), false),
                swath("data.raw", "farm|/|Robot|r", "m|f", new FieldRef("", 1, "", ""), false),
                swath("data.raw", "farm|/|Robot|r", "m", new FieldRef("f|", 1, "", ""), false),
                swath("data.raw", "farm|/|Robot|r", "m", new FieldRef("f", 2, "", ""), false),
                swath("data.hoeing.replay.0a1b2c3d", "farm|/|Robot|r", "m", FIELD, false));

        assertThat(swaths).extracting(Swath::key).doesNotHaveDuplicates();
        assertThat(swaths.get(0).key())
                .as("of another robot, for all")
                .isEqualTo(
                        swath("data.raw", "farm|/|Robot|s", "m", FIELD, false).key());
    }

    private static Swath swath(String topic, String identity, String mission, FieldRef field, boolean ofRobot) {
        PositionFix fix =
                new PositionFix(topic, identity, "r", "Robot", mission, "", 40, -3, Double.NaN, Double.NaN, 1000);
        return new Swath(fix, fix, field, null, Double.NaN, Double.NaN, 0, 2, ofRobot);
    }
}
