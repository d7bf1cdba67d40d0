package io.furrow.simulators.robot;

import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.SplittableRandom;
import java.util.TreeMap;
import java.util.stream.LongStream;
import java.util.stream.Stream;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;
import org.junit.jupiter.params.provider.ValueSource;
import org.locationtech.jts.geom.Coordinate;

import io.furrow.model.position.Position;
import io.furrow.simulators.robot.Trajectory.Pace;
import io.furrow.simulators.robot.Trajectory.Work;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class RobotModelTest {
    private static final Instant START = Instant.parse("2026-06-01T08:00:00Z");
    private static final Pace PACE = new Pace(1.5, 60);
    private static final Position SOUTH = new Position(40.31, -3.48);
    private static final Position NORTH = new Position(40.311, -3.48);
    private static final Trajectory NORTHWARDS = Trajectory.along(List.of(SOUTH, NORTH), PACE);
    private static final RobotModel ALONE = robot("robot-1", NORTHWARDS);

    static Stream<RobotModel> disturbed() {
        return LongStream.range(0, 40)
                .mapToObj(seed -> robot("robot-" + seed, Trajectory.through(square(), new Work(4, 2, null), PACE)));
    }

    @ParameterizedTest
    @MethodSource("disturbed")
    void neverMovesFasterThanItsSpeedAndAlwaysForward(RobotModel robot) {
        List<RobotState> run = run(robot);

        for (int i = 1; i < run.size(); i++) {
            double seconds =
                    Duration.between(run.get(i - 1).time(), run.get(i).time()).toNanos() / 1e9;
            double meters = robot.pose(run.get(i))
                    .meters()
                    .distance(robot.pose(run.get(i - 1)).meters());
            assertThat(meters).isLessThanOrEqualTo(1.5 * seconds + 1e-6);
            assertThat(run.get(i).driven())
                    .isGreaterThanOrEqualTo(run.get(i - 1).driven());
        }
        assertThat(run).extracting(RobotState::activity).contains(Activity.WAITING, Activity.RUNNING);
    }

    @Test
    void stopsAndContinuesOnCommand() {
        RobotState moving = ALONE.advance(RobotState.starting(START, 0), START.plusSeconds(10), Map.of());

        RobotState stopped = moving.commanded(true).commanded(true);
        RobotState later = ALONE.advance(stopped, START.plusSeconds(20), Map.of());

        assertThat(later.activity()).isEqualTo(Activity.STOPPED);
        assertThat(later.driven()).isEqualTo(10);
        assertThat(ALONE.speed(later)).isZero();
        RobotState again = later.commanded(false).commanded(false);
        assertThat(ALONE.advance(again, START.plusSeconds(25), Map.of()).driven())
                .isEqualTo(15);
        assertThat(moving.commanded(false)).isEqualTo(moving);
    }

    @Test
    void staysWhereItIsForATimeThatHasPassed() {
        RobotState state = ALONE.advance(RobotState.starting(START, 0), START.plusSeconds(10), Map.of());

        assertThat(ALONE.advance(state, START.plusSeconds(5), Map.of())).isEqualTo(state);
    }

    /** Two go towards each other on one line; the second waits, then continues. */
    @Test
    void letsTheRobotWithTheSmallerIdPass() {
        RobotModel first = robot("robot-1", NORTHWARDS);
        RobotModel second = robot("robot-2", Trajectory.along(List.of(NORTH, SOUTH), PACE));

        Encounter encounterDistance = meet(List.of(first, second), Duration.ofSeconds(70), 0.5);

        assertThat(encounterDistance.waited("robot-1")).isEmpty();
        assertThat(encounterDistance.waited("robot-2")).isNotEmpty();
        assertThat(encounterDistance.state("robot-1").driven()).isEqualTo(70, within(1e-6));
        assertThat(encounterDistance.state("robot-2").driven()).isBetween(60d, 69.5);
    }

    @ParameterizedTest
    @ValueSource(longs = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10})
    void neverWaitsForEver(long seed) {
        SplittableRandom random = new SplittableRandom(seed);
        List<RobotModel> robots = new ArrayList<>();
        for (int i = 1; i <= 4; i++) {
            Trajectory way = Trajectory.through(square(), new Work(4, 2, random.nextDouble(180)), PACE);
            robots.add(robot("robot-" + i, way));
        }

        Encounter encounterDistance = meet(robots, Duration.ofHours(1), 0.5);

        assertThat(encounterDistance.waited("robot-1")).isEmpty();
        for (RobotModel robot : robots) {
            assertThat(encounterDistance.waited(robot.id()))
                    .allSatisfy(waited -> assertThat(waited).isLessThanOrEqualTo(Duration.ofMillis(20_500)));
            assertThat(encounterDistance.state(robot.id()).driven()).isGreaterThan(900);
        }
        assertThat(encounterDistance.waited("robot-4")).isNotEmpty();
    }

    /** A robot that stands ahead of another does not hold it up forever. */
    @Test
    void passesARobotThatStands() {
        Position there = NORTHWARDS.at(30).place();
        RobotModel second = robot("robot-2", NORTHWARDS);
        RobotState state = RobotState.starting(START, 0);
        for (int beat = 1; beat <= 120; beat++) {
            state = second.advance(state, START.plusMillis(500L * beat), Map.of("robot-1", there));
        }

        assertThat(state.activity()).isEqualTo(Activity.RUNNING);
        assertThat(state.driven()).isBetween(39d, 40d);
        assertThat(state.passing()).isNull();
    }

    /** States and waiting times of robots that worked together. */
    private record Encounter(Map<String, RobotState> states, Map<String, List<Duration>> waits) {
        RobotState state(String id) {
            return states.get(id);
        }

        List<Duration> waited(String id) {
            return waits.getOrDefault(id, List.of());
        }
    }

    private static Encounter meet(List<RobotModel> robots, Duration time, double seconds) {
        Map<String, RobotState> states = new TreeMap<>();
        Map<String, List<Duration>> waits = new TreeMap<>();
        robots.forEach(robot -> states.put(robot.id(), RobotState.starting(START, 0)));
        for (double at = seconds; at <= time.toSeconds(); at += seconds) {
            Map<String, Position> places = new TreeMap<>();
            robots.forEach(robot ->
                    places.put(robot.id(), robot.pose(states.get(robot.id())).place()));
            Instant now = START.plusMillis(Math.round(at * 1000));
            for (RobotModel robot : robots) {
                RobotState after = robot.advance(states.get(robot.id()), now, places);
                states.put(robot.id(), after);
                if (after.activity() == Activity.WAITING) {
                    waits.computeIfAbsent(robot.id(), id -> new ArrayList<>()).add(after.waited());
                }
            }
        }
        return new Encounter(states, waits);
    }

    private static RobotModel robot(String id, Trajectory way) {
        return new RobotModel(id, way, 6, Duration.ofSeconds(20));
    }

    /** Half an hour at random times, with another robot that stands on the way. */
    private static List<RobotState> run(RobotModel robot) {
        SplittableRandom random = new SplittableRandom(1);
        Map<String, Position> others = Map.of("another", robot.way().at(40).place());
        List<RobotState> run = new ArrayList<>(List.of(RobotState.starting(START, 0)));
        Instant now = START;
        while (now.isBefore(START.plusSeconds(1800))) {
            now = now.plusMillis(random.nextLong(50, 1500));
            run.add(robot.advance(run.get(run.size() - 1), now, others));
        }
        return run;
    }

    private static WorkField square() {
        return new WorkField("square", new LocalPlane(SOUTH), WorkField.GEOMETRIES.createPolygon(new Coordinate[] {
            new Coordinate(0, 0),
            new Coordinate(50, 0),
            new Coordinate(50, 40),
            new Coordinate(0, 40),
            new Coordinate(0, 0)
        }));
    }
}
