package io.furrow.cli.recording;

import java.io.FilterInputStream;
import java.io.FilterOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.nio.file.Files;
import java.util.List;
import java.util.function.LongConsumer;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.flink.core.fs.Path;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlPlaneException;
import io.furrow.cli.control.client.ControlTransfer;
import io.furrow.cli.control.client.ListLimit;
import io.furrow.cli.time.Times;
import io.furrow.mission.Recording;
import io.furrow.mission.archive.MissionArchive;
import io.furrow.mission.file.FileRecordings;
import io.furrow.mission.marker.Marker;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.model.topic.TopicName;

/** The missions that a control plane has stored. */
public final class ApiStore implements MissionStore {
    private static final String RECORDINGS = "/api/recordings";
    private static final String LINES = "application/x-ndjson";
    private static final long REPORT_INTERVAL = 10_000;

    private final ControlApi api;
    private final ControlTransfer transfer;
    /** A mission that is open; null for none. */
    private java.nio.file.Path copy;

    public ApiStore(ControlApi api) {
        this.api = api;
        this.transfer = new ControlTransfer(api);
    }

    @Override
    public ControlApi.Page list(ListLimit limit) {
        return limit.read(api, RECORDINGS);
    }

    @Override
    public long export(String mission, OutputStream out, LongConsumer progress) throws IOException {
        LineCount count = new LineCount(progress);
        transfer.download(events(mission), LINES, new FilterOutputStream(out) {
            @Override
            public void write(byte[] bytes, int from, int length) throws IOException {
                out.write(bytes, from, length);
                count.add(bytes, from, length);
            }
        });
        return count.lines;
    }

    /** Copies its lines to a file: not every format can be written in the order of events. */
    @Override
    public Recording open(String mission) throws IOException {
        download(mission);
        return new FileRecordings(copy.toString()).open(mission).orElseThrow();
    }

    private void download(String mission) throws IOException {
        close();
        copy = Files.createTempFile("furrow-export", ".ndjson");
        try (OutputStream out = Files.newOutputStream(copy)) {
            transfer.download(events(mission), LINES, out);
        }
    }

    /** The control plane lists missions by the names of their collections, as archives do. */
    @Override
    public Path folder(String mission, Path root) {
        boolean isListed = api.get(RECORDINGS).findValuesAsText("mission").contains(mission);
        return new Path(root, MissionCollections.PREFIX + (isListed ? mission : TopicName.of(mission)));
    }

    /** Copies its lines to a file first, so that a slow archive does not hold up the control plane. */
    @Override
    public MissionArchive.Outcome archive(String mission, Path root) throws IOException {
        download(mission);
        return MissionArchive.archive(folder(mission, root), new Path(copy.toUri()));
    }

    @Override
    public List<Marker> markers(String mission) {
        return api.get("/api/missions" + ControlApi.part(mission) + "/markers")
                .valueStream()
                .map(ApiStore::marker)
                .toList();
    }

    private static Marker marker(JsonNode json) {
        return new Marker(
                json.path("id").asText(),
                json.path("mission").asText(),
                Times.instant(json.path("time")).toEpochMilli(),
                json.path("note").asText(),
                json.path("author").asText(),
                Times.instant(json.path("created")).toEpochMilli());
    }

    @Override
    public long importFrom(String mission, InputStream in, String source, LongConsumer progress) throws IOException {
        LineCount count = new LineCount(progress);
        InputStream counted = new FilterInputStream(in) {
            @Override
            public int read(byte[] bytes, int from, int length) throws IOException {
                int read = super.read(bytes, from, length);
                count.add(bytes, from, read);
                return read;
            }
        };
        try {
            return transfer.upload(events(mission), LINES, counted)
                    .path("events")
                    .asLong();
        } catch (ControlPlaneException e) {
            throw new ControlPlaneException("%s is not imported: %s".formatted(source, e.getMessage()), e);
        }
    }

    private static String events(String mission) {
        return RECORDINGS + ControlApi.part(mission) + "/events";
    }

    /** Counts lines that pass, and reports their number at intervals. */
    private static final class LineCount {
        private final LongConsumer progress;
        private long lines;

        LineCount(LongConsumer progress) {
            this.progress = progress;
        }

        void add(byte[] bytes, int from, int length) {
            for (int i = from; i < from + length; i++) {
                if (bytes[i] == '\n' && ++lines % REPORT_INTERVAL == 0) {
                    progress.accept(lines);
                }
            }
        }
    }

    @Override
    public void close() throws IOException {
        if (copy != null) {
            Files.deleteIfExists(copy);
        }
    }
}
