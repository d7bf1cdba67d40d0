package io.furrow.simulators.robot;

import java.util.List;
import java.util.SplittableRandom;
import java.util.stream.DoubleStream;
import java.util.stream.Stream;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;
import org.locationtech.jts.geom.Coordinate;
import org.locationtech.jts.geom.Envelope;
import org.locationtech.jts.geom.Geometry;
import org.locationtech.jts.geom.LineSegment;
import org.locationtech.jts.geom.Point;
import org.locationtech.jts.operation.distance.IndexedFacetDistance;

import io.furrow.model.position.Position;
import io.furrow.simulators.robot.Trajectory.Pace;
import io.furrow.simulators.robot.Trajectory.Work;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

class TrajectoryTest {
    private static final Work WORK = new Work(3, 2, null);
    private static final Pace PACE = new Pace(1.5, 45);
    private static final List<Case> CASES = RandomFields.some(40)
            .map(WorkField::of)
            .flatMap(field -> way(field).map(way -> new Case(field, way)))
            .toList();

    /** A field and the way through it. */
    record Case(WorkField field, Trajectory way) {
        @Override
        public String toString() {
            return field.id();
        }

        /** Where the robot is every 0.2 s of a lap, corners included. */
        IndexedFacetDistance driven() {
            return new IndexedFacetDistance(WorkField.GEOMETRIES.createLineString(
                    DoubleStream.iterate(0, time -> time < way.lap() + 0.2, time -> time + 0.2)
                            .mapToObj(time -> way.at(time).meters())
                            .toArray(Coordinate[]::new)));
        }
    }

    static Stream<Case> cases() {
        return CASES.stream();
    }

    /** Empty for the few fields without room for a row. */
    private static Stream<Trajectory> way(WorkField field) {
        try {
            return Stream.of(Trajectory.through(field, WORK, PACE));
        } catch (IllegalArgumentException e) {
            assertThat(e).hasMessageContainingAll(field.id(), "give a smaller margin");
            return Stream.empty();
        }
    }

    @Test
    void findsAWayThroughMostFields() {
        assertThat(cases().count()).isGreaterThan(25);
        assertThat(cases().filter(each -> each.field.area().getNumInteriorRing() > 0)
                        .count())
                .isGreaterThan(10);
    }

    @ParameterizedTest
    @MethodSource("cases")
    void coversEachRow(Case each) {
        IndexedFacetDistance driven = each.driven();
        for (LineSegment row : Rows.of(each.field, WORK.spacing(), WORK.margin(), null)) {
            for (double share : new double[] {0, 0.25, 0.5, 0.75, 1}) {
                Point place = WorkField.GEOMETRIES.createPoint(row.pointAlong(share));
                assertThat(driven.distance(place)).isLessThan(0.16);
            }
        }
    }

    /** A place so far from the edge has a row on each side of it, so it is never further than half a spacing from one. */
    @ParameterizedTest
    @MethodSource("cases")
    void leavesNoPlaceFarFromARow(Case each) {
        IndexedFacetDistance driven = each.driven();
        Geometry inner = each.field.area().buffer(-(WORK.margin() + WORK.spacing()));
        Envelope extent = inner.getEnvelopeInternal();
        SplittableRandom random = new SplittableRandom(1);
        for (int i = 0; i < 200; i++) {
            Point place = WorkField.GEOMETRIES.createPoint(new Coordinate(
                    extent.getMinX() + random.nextDouble() * extent.getWidth(),
                    extent.getMinY() + random.nextDouble() * extent.getHeight()));
            if (inner.covers(place)) {
                assertThat(driven.distance(place)).isLessThan(WORK.spacing() / 2 + 0.16);
            }
        }
    }

    @ParameterizedTest
    @MethodSource("cases")
    void neverMovesOrTurnsFasterThanItsPace(Case each) {
        SplittableRandom random = new SplittableRandom(2);
        for (int i = 0; i < 2000; i++) {
            double time = random.nextDouble(3 * each.way.lap());
            double step = random.nextDouble(4);
            Trajectory.Pose before = each.way.at(time);
            Trajectory.Pose after = each.way.at(time + step);
            assertThat(before.meters().distance(after.meters())).isLessThanOrEqualTo(PACE.speed() * step + 1e-6);
            double turned = Math.abs(after.heading() - before.heading());
            assertThat(Math.min(turned, 360 - turned)).isLessThanOrEqualTo(PACE.turnRate() * step + 1e-6);
        }
    }

    @ParameterizedTest
    @MethodSource("cases")
    void facesWhereItGoesAndTurnsOnTheSpot(Case each) {
        int turns = 0;
        for (double time = 0; time < each.way.lap(); time += 0.5) {
            Trajectory.Pose pose = each.way.at(time);
            Trajectory.Pose next = each.way.at(time + 0.01);
            double heading = Math.toRadians(pose.heading());
            if (pose.turning() && next.turning()) {
                turns++;
                assertThat(next.meters().distance(pose.meters())).isLessThan(1e-9);
            } else if (!pose.turning() && !next.turning()) {
                assertThat(next.meters().x - pose.meters().x)
                        .isEqualTo(0.01 * PACE.speed() * Math.sin(heading), within(1e-6));
                assertThat(next.meters().y - pose.meters().y)
                        .isEqualTo(0.01 * PACE.speed() * Math.cos(heading), within(1e-6));
            }
        }
        assertThat(turns).isPositive();
    }

    @ParameterizedTest
    @MethodSource("cases")
    void comesBackAndGoesAgain(Case each) {
        double lap = each.way.lap();

        for (double time = 0; time < lap; time += 7) {
            assertThat(each.way
                            .at(time + lap)
                            .meters()
                            .distance(each.way.at(time).meters()))
                    .isLessThan(1e-6);
        }
    }

    @Test
    void staysWhereThereIsOnePlace() {
        Position place = new Position(40.3, -3.48);
        Trajectory way = Trajectory.along(List.of(place, place), PACE);

        assertThat(way.at(1e6).place()).isEqualTo(place);
    }

    @Test
    void turnsTheShorterWayRound() {
        List<Position> corner = List.of(new Position(0, 0), new Position(0.001, 0), new Position(0.001, -0.001));
        Trajectory way = Trajectory.along(corner, PACE);

        double driving = 4 * 111.1949 / PACE.speed();
        assertThat(way.lap()).isEqualTo(driving + (90 + 180 + 90 + 180) / PACE.turnRate(), within(0.01));
        assertThat(way.at(111.1949 / PACE.speed() + 1).heading()).isEqualTo(360 - PACE.turnRate(), within(0.1));
    }

    @Test
    void goesAlongTheBearingItIsGiven() {
        WorkField field = cases().findFirst().orElseThrow().field();
        List<LineSegment> rows = Rows.of(field, 3, 2, 30d);

        assertThat(rows).allSatisfy(row -> {
            double bearing = Math.toDegrees(Math.atan2(row.p1.x - row.p0.x, row.p1.y - row.p0.y));
            assertThat(Math.floorMod(Math.round(bearing * 1e6), 180_000_000L)).isBetween(29_999_000L, 30_001_000L);
        });
    }

    @Test
    void reportsWhatToDoWhereAFieldHasNoRoom() {
        WorkField field = cases().findFirst().orElseThrow().field();

        assertThatThrownBy(() -> Trajectory.through(field, new Work(3, 200, null), PACE))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("field '%s' has no room for a row 200.0 m from its edge: give a smaller margin"
                        .formatted(field.id()));
        assertThatThrownBy(() -> new Work(0, 2, null)).hasMessageContaining("at least 0.1 m, not 0.0 and 2.0");
        assertThatThrownBy(() -> new Pace(-1, 45)).hasMessageContaining("above 0, not -1.0 m/s");
    }
}
