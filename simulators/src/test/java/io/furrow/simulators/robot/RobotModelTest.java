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

import io.furrow.model.ngsi.Position;
import io.furrow.simulators.robot.RobotModel.Manners;
import io.furrow.simulators.robot.RobotModel.Surroundings;
import io.furrow.simulators.robot.Way.Pace;
import io.furrow.simulators.robot.Way.Work;
import io.furrow.simulators.signal.Span;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class RobotModelTest {
    private static final Instant START = Instant.parse("2026-06-01T08:00:00Z");
    private static final Pace PACE = new Pace(1.5, 60);
    private static final Manners MANNERS = new Manners(2, 6, Duration.ofSeconds(20));
    private static final Position SOUTH = new Position(40.31, -3.48);
    private static final Position NORTH = new Position(40.311, -3.48);
    private static final Way NORTHWARDS = Way.along(List.of(SOUTH, NORTH), PACE);
    private static final RobotModel ALONE = new RobotModel("robot-1", NORTHWARDS, MANNERS, null);

    static Stream<RobotModel> disturbed() {
        return LongStream.range(0, 40)
                .mapToObj(seed -> new RobotModel(
                        "robot-" + seed,
                        Way.through(square(), new Work(4, 2, null), PACE),
                        MANNERS,
                        new Interruptions(Duration.ofSeconds(20), Duration.ofSeconds(15), 0.5, seed)));
    }

    @ParameterizedTest
    @MethodSource("disturbed")
    void neverMovesFasterThanItsSpeedAndAlwaysForward(RobotModel robot) {
        List<RobotState> run = run(robot, 1);

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
    }

    /** An obstacle may turn up upon a robot; then it stands until that is gone. */
    @ParameterizedTest
    @MethodSource("disturbed")
    void neverDrivesNearerToAnObstacleThanItsClearance(RobotModel robot) {
        List<RobotState> run = run(robot, 2);
        int blocked = 0;

        for (int i = 1; i < run.size(); i++) {
            RobotState before = run.get(i - 1);
            RobotState after = run.get(i);
            blocked += after.activity() == Activity.BLOCKED ? 1 : 0;
            for (Obstacle obstacle : robot.interruptions().between(robot.way(), before.time(), after.time())) {
                if (after.driven() > before.driven()) {
                    assertThat(robot.pose(after)
                                    .meters()
                                    .distance(robot.way().plane().toMeters(obstacle.place())))
                            .isGreaterThan(2.5 - 1e-6);
                }
            }
        }
        assertThat(blocked).isPositive();
        assertThat(run.get(run.size() - 1).driven()).isGreaterThan(100);
    }

    @ParameterizedTest
    @MethodSource("disturbed")
    void doesTheSameAtTheSameTimes(RobotModel robot) {
        Interruptions others = new Interruptions(
                Duration.ofSeconds(20),
                Duration.ofSeconds(15),
                0.5,
                robot.interruptions().seed() + 1);

        assertThat(run(robot, 3)).isEqualTo(run(robot, 3));
        assertThat(run(new RobotModel(robot.id(), robot.way(), MANNERS, others), 3))
                .isNotEqualTo(run(robot, 3));
    }

    @Test
    void standsBeforeAnObstacleUntilItIsGone() {
        Position there = NORTHWARDS.at(40).place();
        Obstacle obstacle = new Obstacle(there, 1, new Span(START, START.plusSeconds(100)));
        Surroundings around = new Surroundings(List.of(obstacle), Map.of());
        RobotState state = RobotState.starting(START, 0);

        state = ALONE.advance(state, START.plusSeconds(60), around);

        assertThat(state.activity()).isEqualTo(Activity.BLOCKED);
        assertThat(ALONE.speed(state)).isZero();
        assertThat(ALONE.pose(state).meters().distance(NORTHWARDS.plane().toMeters(there)))
                .isEqualTo(3, within(1e-6));
        RobotState later = ALONE.advance(state, START.plusSeconds(99), around);
        assertThat(later.driven()).isEqualTo(state.driven(), within(1e-6));
        later = ALONE.advance(later, START.plusSeconds(100), around);
        later = ALONE.advance(later, START.plusSeconds(110), around);
        assertThat(later.activity()).isEqualTo(Activity.RUNNING);
        assertThat(later.driven()).isEqualTo(state.driven() + 10, within(1e-6));
        assertThat(ALONE.speed(later)).isEqualTo(1.5);
    }

    @Test
    void stopsAndGoesOnAsItIsTold() {
        RobotState moving = ALONE.advance(RobotState.starting(START, 0), START.plusSeconds(10), Surroundings.NOTHING);

        RobotState stopped = moving.told(Command.STOP).told(Command.STOP);
        RobotState later = ALONE.advance(stopped, START.plusSeconds(20), Surroundings.NOTHING);

        assertThat(later.activity()).isEqualTo(Activity.STOPPED);
        assertThat(later.driven()).isEqualTo(10);
        assertThat(ALONE.speed(later)).isZero();
        for (Command command : List.of(Command.RESUME, Command.RUNNING)) {
            RobotState again = later.told(command).told(command);
            assertThat(ALONE.advance(again, START.plusSeconds(25), Surroundings.NOTHING)
                            .driven())
                    .isEqualTo(15);
        }
        assertThat(moving.told(Command.RUNNING)).isEqualTo(moving);
    }

    @Test
    void staysWhereItIsForATimeThatHasPassed() {
        RobotState state = ALONE.advance(RobotState.starting(START, 0), START.plusSeconds(10), Surroundings.NOTHING);

        assertThat(ALONE.advance(state, START.plusSeconds(5), Surroundings.NOTHING))
                .isEqualTo(state);
    }

    @Test
    void knowsItsCommandsByTheirWords() {
        assertThat(Command.of("Running")).contains(Command.RUNNING);
        assertThat(Command.of("Stop")).contains(Command.STOP);
        assertThat(Command.of("Resume")).contains(Command.RESUME);
        assertThat(Command.of("stop")).isEmpty();
    }

    /** Two go towards each other on one line; the second waits, then goes on. */
    @Test
    void letsTheRobotWithTheSmallerIdPass() {
        RobotModel first = new RobotModel("robot-1", NORTHWARDS, MANNERS, null);
        RobotModel second = new RobotModel("robot-2", Way.along(List.of(NORTH, SOUTH), PACE), MANNERS, null);

        Meeting meeting = meet(List.of(first, second), Duration.ofSeconds(70), 0.5);

        assertThat(meeting.waited("robot-1")).isEmpty();
        assertThat(meeting.waited("robot-2")).isNotEmpty();
        assertThat(meeting.state("robot-1").driven()).isEqualTo(70, within(1e-6));
        assertThat(meeting.state("robot-2").driven()).isBetween(60d, 69.5);
    }

    @ParameterizedTest
    @ValueSource(longs = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10})
    void neverWaitsForEver(long seed) {
        SplittableRandom random = new SplittableRandom(seed);
        List<RobotModel> robots = new ArrayList<>();
        for (int i = 1; i <= 4; i++) {
            Way way = Way.through(square(), new Work(4, 2, random.nextDouble(180)), PACE);
            robots.add(new RobotModel("robot-" + i, way, MANNERS, null));
        }

        Meeting meeting = meet(robots, Duration.ofHours(1), 0.5);

        assertThat(meeting.waited("robot-1")).isEmpty();
        for (RobotModel robot : robots) {
            assertThat(meeting.waited(robot.id()))
                    .allSatisfy(waited -> assertThat(waited).isLessThanOrEqualTo(Duration.ofMillis(20_500)));
            assertThat(meeting.state(robot.id()).driven()).isGreaterThan(900);
        }
        assertThat(meeting.waited("robot-4")).isNotEmpty();
    }

    /** One who is stopped before another does not hold it up for ever. */
    @Test
    void passesARobotThatStands() {
        Position there = NORTHWARDS.at(30).place();
        RobotModel second = new RobotModel("robot-2", NORTHWARDS, MANNERS, null);
        Surroundings around = new Surroundings(List.of(), Map.of("robot-1", there));
        RobotState state = RobotState.starting(START, 0);
        for (int beat = 1; beat <= 120; beat++) {
            state = second.advance(state, START.plusMillis(500L * beat), around);
        }

        assertThat(state.activity()).isEqualTo(Activity.RUNNING);
        assertThat(state.driven()).isBetween(39d, 40d);
        assertThat(state.passing()).isNull();
    }

    /** What became of robots that were at it together. */
    private record Meeting(Map<String, RobotState> states, Map<String, List<Duration>> waits) {
        RobotState state(String id) {
            return states.get(id);
        }

        List<Duration> waited(String id) {
            return waits.getOrDefault(id, List.of());
        }
    }

    private static Meeting meet(List<RobotModel> robots, Duration time, double seconds) {
        Map<String, RobotState> states = new TreeMap<>();
        Map<String, List<Duration>> waits = new TreeMap<>();
        robots.forEach(robot -> states.put(robot.id(), RobotState.starting(START, 0)));
        for (double at = seconds; at <= time.toSeconds(); at += seconds) {
            Map<String, Position> places = new TreeMap<>();
            robots.forEach(robot ->
                    places.put(robot.id(), robot.pose(states.get(robot.id())).place()));
            Instant now = START.plusMillis(Math.round(at * 1000));
            for (RobotModel robot : robots) {
                RobotState after = robot.advance(states.get(robot.id()), now, new Surroundings(List.of(), places));
                states.put(robot.id(), after);
                if (after.activity() == Activity.WAITING) {
                    waits.computeIfAbsent(robot.id(), id -> new ArrayList<>()).add(after.waited());
                }
            }
        }
        return new Meeting(states, waits);
    }

    /** Half an hour at times that depend on the seed. */
    private static List<RobotState> run(RobotModel robot, long seed) {
        SplittableRandom random = new SplittableRandom(seed);
        List<RobotState> run = new ArrayList<>(List.of(RobotState.starting(START, 0)));
        Instant now = START;
        while (now.isBefore(START.plusSeconds(1800))) {
            now = now.plusMillis(random.nextLong(50, 1500));
            run.add(robot.advance(run.get(run.size() - 1), now, Surroundings.NOTHING));
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
