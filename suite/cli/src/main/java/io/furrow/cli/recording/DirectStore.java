package io.furrow.cli.recording;

import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.util.List;
import java.util.function.LongConsumer;

import com.fasterxml.jackson.databind.node.ArrayNode;
import org.apache.flink.core.fs.Path;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ListLimit;
import io.furrow.cli.option.CommandException;
import io.furrow.mission.Recording;
import io.furrow.mission.RecordingDeletedException;
import io.furrow.mission.archive.MissionArchive;
import io.furrow.mission.archive.StoredMissions;
import io.furrow.mission.marker.Marker;
import io.furrow.mission.marker.Markers;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.MongoRecordings;
import io.furrow.model.ngsi.NgsiJson;

/** The missions of a MongoDB. */
public final class DirectStore implements MissionStore {
    private final String mongo;
    private final StoredMissions missions;

    /** @throws IllegalArgumentException if the URI is invalid */
    public DirectStore(String mongo) {
        this.mongo = mongo;
        this.missions = StoredMissions.open(mongo);
    }

    @Override
    public ControlApi.Page list(ListLimit limit) {
        ArrayNode stored = NgsiJson.array();
        missions.all()
                .forEach(mission -> stored.addObject()
                        .put("mission", mission.mission())
                        .put("events", mission.events())
                        .put("first", mission.first().toString())
                        .put("last", mission.last().toString()));
        return limit.cut(stored);
    }

    /** @throws CommandException if nothing is stored of a mission */
    private void require(String mission) {
        if (!missions.has(mission)) {
            throw new CommandException(
                    "No mission named %s is stored; ./furrow mission stored shows those that are.".formatted(mission));
        }
    }

    @Override
    public long export(String mission, OutputStream out, LongConsumer progress) throws IOException {
        require(mission);
        return missions.export(mission, out, progress);
    }

    @Override
    public Recording open(String mission) throws IOException {
        require(mission);
        return new MongoRecordings(mongo, MongoAccess.DATABASE)
                .open(mission)
                .orElseThrow(
                        () -> new RecordingDeletedException("Mission %s has just been deleted".formatted(mission)));
    }

    @Override
    public Path folder(String mission, Path root) {
        return new MissionArchive(missions, root).folder(mission);
    }

    @Override
    public MissionArchive.Outcome archive(String mission, Path root) throws IOException {
        require(mission);
        return new MissionArchive(missions, root).archive(mission);
    }

    @Override
    public List<Marker> markers(String mission) throws IOException {
        try (Markers markers = Markers.open(mongo, MongoAccess.DATABASE)) {
            return markers.list(mission);
        }
    }

    @Override
    public long importFrom(String mission, InputStream in, String source, LongConsumer progress)
            throws IOException, InterruptedException {
        return missions.importFrom(mission, in, source, progress);
    }

    @Override
    public void close() {
        missions.close();
    }
}
