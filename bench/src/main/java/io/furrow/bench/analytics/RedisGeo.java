package io.furrow.bench.analytics;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;
import java.util.stream.Stream;

import redis.clients.jedis.GeoCoordinate;
import redis.clients.jedis.Jedis;
import redis.clients.jedis.Pipeline;
import redis.clients.jedis.Response;
import redis.clients.jedis.args.GeoUnit;
import redis.clients.jedis.exceptions.JedisConnectionException;
import redis.clients.jedis.resps.GeoRadiusResponse;

import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.PositionFix;
import io.furrow.bench.analytics.load.Fleet;
import io.furrow.embedded.FreePort;

/**
 * A Redis in its own process: each position is stored with {@code GEOADD}, and {@code GEOSEARCH} finds the devices within the threshold.
 * One connection, pipelined; nothing is persisted, nothing expires, and close pairs are not tracked.
 */
final class RedisGeo implements AutoCloseable {
    private static final String SERVER = "redis-server";
    private static final String HOST = "127.0.0.1";
    private static final Duration START = Duration.ofSeconds(10);
    private static final byte[] KEY = "positions".getBytes(StandardCharsets.US_ASCII);
    /** Positions per pipeline. */
    private static final int PIPELINED = 500;

    private static final int NEARBY_PAIRS = 1_000;

    private final double threshold = CollisionRules.DEFAULT.thresholdMeters();
    private final Process server;
    private final Jedis client;
    private final Pipeline pipeline;
    private final List<Response<List<GeoRadiusResponse>>> open = new ArrayList<>(PIPELINED);
    private long found;

    /**
     * The result beside that of the bare loop.
     *
     * @param perSecond positions
     * @param close devices found near the positions of {@link #nearby}
     * @param expected close pairs after them in the bare loop
     */
    record Result(double perSecond, long close, long expected) {}

    private RedisGeo(Process server, int port) throws InterruptedException {
        this.server = server;
        this.client = connect(server, port);
        this.pipeline = client.pipelined();
    }

    static boolean isInstalled() {
        return Stream.of(System.getenv("PATH").split(":"))
                .anyMatch(folder -> Files.isExecutable(Path.of(folder, SERVER)));
    }

    static RedisGeo start() throws IOException, InterruptedException {
        int port = FreePort.orFree(0);
        Process server = new ProcessBuilder(
                        SERVER, "--bind", HOST, "--port", Integer.toString(port), "--save", "", "--appendonly", "no")
                .redirectOutput(ProcessBuilder.Redirect.DISCARD)
                .redirectError(ProcessBuilder.Redirect.INHERIT)
                .start();
        try {
            return new RedisGeo(server, port);
        } catch (RuntimeException | InterruptedException e) {
            server.destroy();
            throw e;
        }
    }

    private static Jedis connect(Process server, int port) throws InterruptedException {
        long end = System.nanoTime() + START.toNanos();
        while (true) {
            Jedis client = new Jedis(HOST, port);
            try {
                client.ping();
                return client;
            } catch (JedisConnectionException e) {
                client.close();
                if (!server.isAlive() || System.nanoTime() > end) {
                    throw new IllegalStateException(SERVER + " does not answer at port " + port, e);
                }
                Thread.sleep(50);
            }
        }
    }

    /** Measures the rate for a fleet's positions, after a warm-up of a quarter of the time, and the devices found. */
    static Result measure(int devices, Duration lasting) throws IOException, InterruptedException {
        try (RedisGeo redis = start()) {
            BaselineLoop loop = new BaselineLoop(2 * NEARBY_PAIRS);
            nearby(fix -> {
                redis.take(fix);
                loop.take(fix);
            });
            redis.sync();
            long close = redis.found;
            redis.client.del(KEY);
            Fleet fleet = new Fleet(devices, 0, 1);
            long warm = redis.run(fleet, 0, lasting.dividedBy(4));
            long begin = System.nanoTime();
            long ticks = redis.run(fleet, warm, lasting) - warm;
            double seconds = (System.nanoTime() - begin) / 1e9;
            return new Result(ticks / (double) Fleet.TICKS_PER_SECOND * devices / seconds, close, loop.close());
        }
    }

    /** @return the first tick that was not sent */
    private long run(Fleet fleet, long from, Duration lasting) {
        long end = System.nanoTime() + lasting.toNanos();
        long tick = from;
        for (; System.nanoTime() < end; tick++) {
            fleet.tick(tick, this::take);
        }
        sync();
        return tick;
    }

    /**
     * Pairs that are 0.5, 1.5 … 9.5 m apart, and far from all others: Redis rounds coordinates to some decimeters, so that its results
     * differ from the definition near the threshold.
     */
    private static void nearby(Consumer<PositionFix> out) {
        for (int pair = 0; pair < NEARBY_PAIRS; pair++) {
            for (int device = 0; device < 2; device++) {
                String id = "urn:ngsi-ld:Robot:" + (2 * pair + device);
                double north = 100.0 * pair;
                out.accept(Fleet.at(id, device * (pair % 10 + 0.5), north, Fleet.START + pair));
            }
        }
    }

    private void take(PositionFix fix) {
        byte[] member = fix.id().getBytes(StandardCharsets.US_ASCII);
        pipeline.geoadd(KEY, fix.longitude(), fix.latitude(), member);
        open.add(pipeline.geosearch(KEY, new GeoCoordinate(fix.longitude(), fix.latitude()), threshold, GeoUnit.M));
        if (open.size() == PIPELINED) {
            sync();
        }
    }

    /** Counts all devices found except the device itself. */
    private void sync() {
        pipeline.sync();
        open.forEach(answer -> found += answer.get().size() - 1);
        open.clear();
    }

    @Override
    public void close() {
        client.close();
        server.destroy();
        server.onExit().join();
    }
}
