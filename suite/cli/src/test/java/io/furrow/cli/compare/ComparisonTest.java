package io.furrow.cli.compare;

import java.util.List;
import java.util.Map;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.analytics.collision.CollisionEntity;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.position.PositionFix;
import io.furrow.cli.compare.AnalyticsResult.Encounter;
import io.furrow.cli.compare.ResultMatch.Verdict;
import io.furrow.model.ngsi.Entity;

import static io.furrow.cli.compare.ResultRecords.T0;
import static io.furrow.cli.compare.ResultRecords.average;
import static io.furrow.cli.compare.ResultRecords.encounter;
import static io.furrow.cli.compare.ResultRecords.entered;
import static io.furrow.cli.compare.ResultRecords.left;
import static io.furrow.cli.compare.ResultRecords.side;
import static org.assertj.core.api.Assertions.assertThat;

class ComparisonTest {
    @Test
    void isTheSameWhateverTheOrderInWhichRecordsCame() {
        SideResults a = side(
                "a",
                encounter("xy", "started", 4, 10, 10),
                encounter("xy", "ongoing", 3, 10, 12),
                encounter("xy", "ended", 2.5, 10, 15),
                entered("x", "f", 1),
                left("x", "f", 1, 9),
                average("f", 0, 21.5, "robust", "x"));
        SideResults b = side(
                "b",
                left("x", "f", 1, 9),
                entered("x", "f", 1),
                encounter("xy", "ended", 2.5, 10, 15),
                encounter("xy", "started", 4, 10, 10),
                average("f", 0, 21.5 + 1e-9, "robust", "x"));

        Comparison comparison = Comparison.of(a, b, TimeRange.ALL);

        assertThat(comparison.isSame()).isTrue();
        assertThat(List.of(ResultKind.values()))
                .allSatisfy(kind -> assertThat(comparison.matches().get(kind)).hasSize(1));
    }

    @Test
    void matchesEncountersOfAPairByTheLongestCommonTime() {
        SideResults a = side("a", encounter("xy", "ended", 2, 0, 10), encounter("xy", "ended", 2, 20, 30));
        SideResults b = side(
                "b",
                encounter("xy", "ended", 2, 9, 12),
                encounter("xy", "ended", 1.5, 2, 8),
                encounter("xz", "ended", 2, 20, 30));

        List<ResultMatch> matches = Comparison.of(a, b, TimeRange.ALL).matches().get(ResultKind.ENCOUNTERS);

        assertThat(matches)
                .extracting(ResultMatch::verdict)
                .containsExactly(Verdict.CHANGED, Verdict.ONLY_B, Verdict.ONLY_A, Verdict.ONLY_B);
        assertThat(matches.get(0).changes())
                .containsExactly(
                        new MemberDifference("closest", 2.0, 1.5),
                        new MemberDifference("start", T0, T0 + 2000),
                        new MemberDifference("end", T0 + 10_000, T0 + 8000));
    }

    @ParameterizedTest
    @CsvSource({"21.6, robust, x, mean", "21.5, unverified, x, quality", "21.5, robust, y, suspects"})
    void reportsInWhatAWindowDiffers(double mean, String quality, String suspect, String member) {
        SideResults a = side("a", average("f", 0, 21.5, "robust", "x"));
        SideResults b = side("b", average("f", 0, mean, quality, suspect));

        List<ResultMatch> matches = Comparison.of(a, b, TimeRange.ALL).matches().get(ResultKind.AVERAGES);

        assertThat(matches)
                .singleElement()
                .satisfies(match -> assertThat(match.changes())
                        .extracting(MemberDifference::member)
                        .containsExactly(member));
    }

    @Test
    void takesAWindowWithoutReadingsForNone() {
        SideResults a = side("a", average("f", 0, 21.5, "robust"), average("f", 10, Double.NaN, "unverified"));
        SideResults b = side("b", average("f", 0, 21.5, "robust"));

        assertThat(Comparison.of(a, b, TimeRange.ALL).isSame()).isTrue();

        SideResults more = side("b", average("f", 0, 21.5, "robust"), average("f", 10, 20, "robust"));
        assertThat(Comparison.of(a, more, TimeRange.ALL).differences(ResultKind.AVERAGES))
                .singleElement()
                .satisfies(match -> assertThat(match.changes()).contains(new MemberDifference("mean", null, 20.0)));
    }

    @Test
    void doesNotTakeAnEndThatIsNotReportedForADifference() {
        SideResults a = side("a", encounter("xy", "ongoing", 2, 0, 5), entered("x", "f", 1));
        SideResults b = side("b", encounter("xy", "ended", 2, 0, 9), left("x", "f", 1, 9));

        assertThat(Comparison.of(a, b, TimeRange.ALL).isSame()).isTrue();
    }

    @Test
    void comparesWithinARangeOnly() {
        SideResults a =
                side("a", encounter("xy", "ended", 2, 0, 20), average("f", 0, 20, "robust"), left("x", "f", 0, 9));
        SideResults b = side("b", encounter("xy", "ended", 2, 10, 25), left("x", "f", 30, 40));

        assertThat(Comparison.of(a, b, new TimeRange(T0 + 10_000, T0 + 20_000)).isSame())
                .isTrue();
        assertThat(Comparison.of(a, b, new TimeRange(T0, T0 + 20_000)).isSame()).isFalse();
    }

    @Test
    void passesOverThePredictedAndWhatOtherMissionsFound() {
        ResultCollector collector = new ResultCollector("sowing");
        collector.add(ResultKind.ENCOUNTERS, 0, "farm|/", encounter("xy", "ended", 2, 0, 20));
        collector.add(ResultKind.STAYS, 0, "farm|/", entered("x", "f", 1));
        assertThat(collector.spans(ResultKind.ENCOUNTERS)).isEmpty();
        assertThat(collector.spans(ResultKind.STAYS)).isEmpty();

        ResultCollector every = new ResultCollector(null);
        every.add(ResultKind.ENCOUNTERS, 0, "farm|/", encounter("xz", "predicted", 2, 0, 20));
        every.add(ResultKind.ENCOUNTERS, 0, "farm|/", encounter("xy", "ended", 2, 0, 20));
        assertThat(every.spans(ResultKind.ENCOUNTERS)).hasSize(1);
    }

    @Test
    void startsOverWithANewerEpoch() {
        ResultCollector collector = new ResultCollector(null);
        collector.add(ResultKind.STAYS, 0, "farm|/", entered("x", "f", 1));
        collector.add(ResultKind.STAYS, 2, "farm|/", entered("y", "f", 1));
        collector.add(ResultKind.STAYS, 1, "farm|/", entered("z", "f", 1));

        assertThat(collector.spans(ResultKind.STAYS))
                .singleElement()
                .satisfies(visit -> assertThat(visit.subject().name()).isEqualTo("y in f"));
        assertThat(collector.epoch()).isEqualTo(2);
    }

    @Test
    void distinguishesTenantsOnlyWhereThereAreSeveral() {
        ResultCollector one = new ResultCollector(null);
        one.add(ResultKind.STAYS, 0, "farm|/", left("x", "f", 1, 2));
        ResultCollector other = new ResultCollector(null);
        other.add(ResultKind.STAYS, 0, "|", left("x", "f", 1, 2));
        assertThat(Comparison.of(side("a", one), side("b", other), TimeRange.ALL)
                        .isSame())
                .isTrue();

        other.add(ResultKind.STAYS, 0, "farm|/", left("y", "f", 1, 2));
        assertThat(Comparison.of(side("a", one), side("b", other), TimeRange.ALL)
                        .isSame())
                .isFalse();
    }

    /** Both stays have the same field, device id and time. */
    @Test
    void distinguishesEntitiesOfOneId() {
        Comparison comparison = Comparison.of(
                side("a", left("x", "Robot", "f", 1, 2), left("x", "Camera", "f", 1, 2)),
                side("b", left("x", "Robot", "f", 1, 2)),
                TimeRange.ALL);

        assertThat(comparison.matches().get(ResultKind.STAYS))
                .filteredOn(match -> match.verdict() != Verdict.SAME)
                .singleElement()
                .satisfies(match -> assertThat(match.subject().types()).isEqualTo("Camera"));
        assertThat(comparison.matches().get(ResultKind.STAYS))
                .as("the page sorts them by subject")
                .extracting(ResultMatch::subject)
                .usingElementComparator(ResultSubject::compareTo)
                .doesNotHaveDuplicates();
    }

    /** The job's own entity, in an epoch that is not the first. */
    @Test
    void readsEncountersAsTheJobWritesThem() {
        long epoch = 3L << 44;
        io.furrow.analytics.collision.encounter.Encounter found = new io.furrow.analytics.collision.encounter.Encounter(
                Phase.ENDED,
                fix("x", epoch + T0 + 4000),
                fix("y", epoch + T0 + 4000),
                4,
                1.25,
                epoch + T0,
                epoch + T0 + 5000);
        Entity entity = CollisionEntity.of(found).build();

        ResultCollector collector = new ResultCollector("weeding");
        collector.add(ResultKind.ENCOUNTERS, 3, "farm|/", entity);

        assertThat(collector.spans(ResultKind.ENCOUNTERS))
                .containsExactly(
                        new Encounter(new ResultSubject("farm|/", "Robot Robot", "x – y"), T0, T0 + 5000, false, 1.25));
    }

    @Test
    void distinguishesAnEncounterWithADeviceOfAnotherTenant() {
        ResultCollector within = new ResultCollector(null);
        ResultCollector across = new ResultCollector(null);
        PositionFix first = fix("farm|/|", "x", T0);
        for (var each : Map.of(within, "farm|/|", across, "other|/|").entrySet()) {
            PositionFix second = fix(each.getValue(), "y", T0);
            var found = new io.furrow.analytics.collision.encounter.Encounter(
                    Phase.ENDED, first, second, 4, 1.25, T0, T0 + 5000);
            each.getKey()
                    .add(
                            ResultKind.ENCOUNTERS,
                            0,
                            "farm|/",
                            CollisionEntity.of(found).build());
        }
        assertThat(Comparison.of(side("a", within), side("b", within), TimeRange.ALL)
                        .isSame())
                .isTrue();
        assertThat(Comparison.of(side("a", within), side("b", across), TimeRange.ALL)
                        .isSame())
                .isFalse();
    }

    private static PositionFix fix(String id, long time) {
        return fix("farm|/|", id, time);
    }

    private static PositionFix fix(String scope, String id, long time) {
        return new PositionFix(
                "data.weeding.replay.0a1b2c3d", scope + id, id, "Robot", "weeding", "", 40, -3, 0, 0, time);
    }
}
