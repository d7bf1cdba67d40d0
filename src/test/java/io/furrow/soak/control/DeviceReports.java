package io.furrow.soak.control;

import java.util.List;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;

import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Writes reports of the devices of all running missions to {@code data.raw}, except of silenced missions. */
final class DeviceReports {
    private final RequestSender sender;
    private final List<MissionActor> missions;
    private final Set<String> silent = ConcurrentHashMap.newKeySet();

    DeviceReports(RequestSender sender, List<MissionActor> missions) {
        this.sender = sender;
        this.missions = missions;
    }

    void silence(String mission) {
        silent.add(mission);
    }

    void resume(String mission) {
        silent.remove(mission);
    }

    /** Writes one report of each device. */
    void step() {
        for (MissionActor mission : missions) {
            if (mission.isRunning() && !silent.contains(mission.mission())) {
                mission.devices().forEach(this::report);
            }
        }
    }

    private void report(String id) {
        var entity = Entity.builder(id, "Thermometer").number("Temperature", 20).build();
        ProducerRecord<String, byte[]> record = new ProducerRecord<>(Topics.RAW, id, entity.toBytes());
        record.headers().add(HeaderNames.SERVICE, "farm".getBytes(UTF_8));
        record.headers().add(HeaderNames.SERVICE_PATH, "/".getBytes(UTF_8));
        sender.write(record);
    }
}
