package io.furrow.bench.ngsi;

import java.util.Set;
import java.util.concurrent.TimeUnit;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import org.openjdk.jmh.annotations.Benchmark;
import org.openjdk.jmh.annotations.BenchmarkMode;
import org.openjdk.jmh.annotations.Fork;
import org.openjdk.jmh.annotations.Measurement;
import org.openjdk.jmh.annotations.Mode;
import org.openjdk.jmh.annotations.OutputTimeUnit;
import org.openjdk.jmh.annotations.Param;
import org.openjdk.jmh.annotations.Scope;
import org.openjdk.jmh.annotations.Setup;
import org.openjdk.jmh.annotations.State;
import org.openjdk.jmh.annotations.Warmup;
import org.openjdk.jmh.infra.Blackhole;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.position.EntityReader;
import io.furrow.model.position.PositionReading;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Id, type, position and mission out of the bytes of an entity: with a tree of what is requested, and without one. */
@State(Scope.Thread)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.NANOSECONDS)
@Fork(1)
@Warmup(iterations = 5, time = 1)
@Measurement(iterations = 5, time = 1)
public class EntityReadingBenchmark {
    private static final Set<String> ATTRIBUTES = Set.of("Mission", "carriedBy", "refRobot", "speed", "heading");
    private static final Set<String> WANTED = Stream.concat(ATTRIBUTES.stream(), PositionReading.ATTRIBUTES.stream())
            .collect(Collectors.toSet());

    @Param({"thermometer", "robot", "firos", "camera"})
    private String entity;

    private byte[] bytes;
    private EntityReader reader;

    @Setup
    public void write() {
        String attributes = switch (entity) {
            case "robot" -> """
                            "location":{"type":"geo:json","value":{"type":"Point","coordinates":[-3.4821764,40.3125281]},\
                            "metadata":{"TimeInstant":{"type":"DateTime","value":"2026-11-21T01:00:00.000Z"}}},\
                            "speed":{"type":"Number","value":1.75,"metadata":{}},"heading":{"type":"Number","value":271.5,\
                            "metadata":{}},"Mission":{"type":"String","value":"hoeing-7","metadata":{}},"Status":{"type":\
                            "Boolean","value":true,"metadata":{}},"Time":{"type":"Integer","value":1795223400000,"metadata":{}}""";
            case "firos" -> """
                            "gnss":{"type":"sensor_msgs.msg.NavSatFix","value":"{%27header%27: {%27seq%27: 4711, %27stamp%27: \
                            {%27secs%27: 1795223400, %27nsecs%27: 120000000}, %27frame_id%27: %27gps%27}, %27latitude%27: \
                            40.3125281, %27longitude%27: -3.4821764, %27altitude%27: 650.25, %27position_covariance%27: [1.0, 0.0, \
                            0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 4.0]}","metadata":{}},"cmd":{"type":"COMMAND","value":["gnss"],\
                            "metadata":{}}""";
            case "camera" ->
                measured() + ",\"Image\":{\"type\":\"String\",\"value\":\"" + "aGVsbG8gd29ybGQh".repeat(6250)
                        + "\",\"metadata\":{}}";
            default -> measured();
        };
        bytes = ("{\"id\":\"urn:ngsi-ld:Device:17\",\"type\":\"Device\"," + attributes + "}").getBytes(UTF_8);
        reader = new EntityReader(ATTRIBUTES);
    }

    private static String measured() {
        return """
                "Domain":{"type":"String","value":"north","metadata":{}},"Mission":{"type":"String","value":"hoeing-7",\
                "metadata":{}},"Latitude":{"type":"Float","value":40.3125281,"metadata":{}},"Longitude":{"type":"Float","value":\
                -3.4821764,"metadata":{}},"Location":{"type":"String","value":"40.3125281, -3.4821764","metadata":{}},"Status":{\
                "type":"Boolean","value":true,"metadata":{}},"Temperature":{"type":"Float","value":21.5,"metadata":{}},"Time":{\
                "type":"Integer","value":1795223400000,"metadata":{}}""";
    }

    @Benchmark
    public void withATree(Blackhole out) throws UnreadableException {
        Entity read = Entity.parse(bytes, WANTED);
        out.consume(read.id());
        out.consume(read.type());
        out.consume(PositionReading.of(read));
        out.consume(read.text("Mission"));
        out.consume(read.number("speed"));
        out.consume(read.number("heading"));
    }

    @Benchmark
    public void withoutATree(Blackhole out) throws UnreadableException {
        reader.read(bytes);
        out.consume(reader.id());
        out.consume(reader.type());
        out.consume(reader.position());
        out.consume(reader.text("Mission"));
        out.consume(reader.number("speed"));
        out.consume(reader.number("heading"));
    }
}
