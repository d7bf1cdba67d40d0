package io.furrow.flink;

import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.typeutils.TypeSerializer;
import org.apache.flink.core.memory.DataInputDeserializer;
import org.apache.flink.core.memory.DataOutputSerializer;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.graph.StreamNode;

import io.furrow.flink.format.VersionedSerializerSnapshot;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * The uids of a job's operators, sorted. State is found by them after a restart, so a job's list is checked in: a changed
 * or lost uid is then seen in review.
 */
public final class JobUids {
    private JobUids() {}

    /** What the stream graph has; fails on an operator without a uid, whose state no savepoint could give back. */
    public static List<String> of(StreamExecutionEnvironment env) {
        return env.getStreamGraph(false).getStreamNodes().stream()
                .map(JobUids::uid)
                .sorted()
                .toList();
    }

    /** What is checked in as {@code src/test/resources/uids/<job>.txt}, one uid a line. */
    public static List<String> checkedIn(String job) {
        String resource = "/uids/" + job + ".txt";
        try (InputStream list = JobUids.class.getResourceAsStream(resource)) {
            if (list == null) {
                throw new AssertionError("src/test/resources" + resource + " is missing; write the job's uids there");
            }
            return new String(list.readAllBytes(), UTF_8).lines().toList();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    /** The formats of the keys by which the job keeps state, each with its version, as a savepoint has them. */
    public static Map<String, Integer> keyFormats(StreamExecutionEnvironment env) throws IOException {
        Map<String, Integer> versions = new HashMap<>();
        for (StreamNode node : env.getStreamGraph(false).getStreamNodes()) {
            TypeSerializer<?> key = node.getStateKeySerializer();
            if (key != null && key.snapshotConfiguration() instanceof VersionedSerializerSnapshot<?> snapshot) {
                DataOutputSerializer out = new DataOutputSerializer(64);
                snapshot.writeSnapshot(out);
                DataInputDeserializer in = new DataInputDeserializer(out.getSharedBuffer());
                versions.put(in.readUTF(), in.readInt());
            }
        }
        return versions;
    }

    private static String uid(StreamNode node) {
        String uid = node.getTransformationUID();
        if (uid == null) {
            throw new AssertionError("operator '" + node.getOperatorName() + "' has no uid");
        }
        return uid;
    }
}
