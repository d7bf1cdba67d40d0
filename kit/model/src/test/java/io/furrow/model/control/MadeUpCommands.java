package io.furrow.model.control;

import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** Generates commands of all kinds, with and without optional members. */
public record MadeUpCommands(Random random) {
    public DomainCommand domain() {
        return switch (random.nextInt(4)) {
            case 0 -> new DomainCommand.Create(name(), details());
            case 1 -> new DomainCommand.Change(name(), details());
            case 2 ->
                new DomainCommand.Patch(
                        name(), JsonNodeFactory.instance.objectNode().put("name", maybe("N")));
            default -> new DomainCommand.Delete(name(), random.nextBoolean());
        };
    }

    public MissionCommand mission() {
        return switch (random.nextInt(7)) {
            case 0 -> new MissionCommand.Create(name(), name(), plan());
            case 1 -> new MissionCommand.Stop(name());
            case 2 -> new MissionCommand.Delete(name());
            case 3 ->
                new MissionCommand.SaveTemplate(
                        new MissionTemplate(name(), random.nextInt(3), maybe("Ürö €𝄞"), devices()));
            case 4 -> new MissionCommand.DeleteTemplate(name(), random.nextInt(3));
            case 5 -> new MissionCommand.RotateCredentials("urn:ngsi-ld:Thermometer:" + name() + "-1");
            default -> new MissionCommand.Start(name(), maybe(name()), plan(), maybe(time()), maybe(duration()));
        };
    }

    public ReplayCommand replay() {
        ReplayCommand.Target target = random.nextInt(3) == 0
                ? new ReplayCommand.Target(null, "0a1b2c3d")
                : ReplayCommand.Target.of(name() + ".0a1b2c3d");
        return switch (random.nextInt(6)) {
            case 0 -> new ReplayCommand.Simple(target, ReplayCommand.Verb.values()[random.nextInt(3)]);
            case 1 -> new ReplayCommand.Seek(target, time());
            case 2 -> new ReplayCommand.Speed(target, speed());
            case 3 -> new ReplayCommand.Step(target, random.nextInt(9) + (random.nextBoolean() ? 1 : -9));
            case 4 -> new ReplayCommand.Loop(target, maybe(range()));
            default ->
                random.nextBoolean()
                        ? new ReplayCommand.Start(
                                List.of(name()),
                                maybe("data.n.replay.0a1b2c3d"),
                                speed(),
                                maybe(range()),
                                replayPlan(maybe(1500L)))
                        : new ReplayCommand.Start(List.of("a", "b"), null, 2.5, maybe(range()), replayPlan(null));
        };
    }

    private DesiredReplay.Range range() {
        long from = time().toEpochMilli();
        return new DesiredReplay.Range(from, from + 1 + random.nextInt(99));
    }

    private ReplayPlan replayPlan(Long maxGap) {
        return new ReplayPlan(
                maxGap == null ? null : new ReplayPlan.Source(null, "f.jsonl"),
                maybe(time().toEpochMilli()),
                null,
                random.nextBoolean(),
                List.of("urn:x:1", "urn:x:2"),
                maxGap,
                ReplayPlan.Stamps.values()[random.nextInt(2)],
                maybe(time().toEpochMilli()),
                List.of("collision"));
    }

    private DomainDetails details() {
        ObjectNode area = JsonNodeFactory.instance.objectNode().put("type", "Polygon");
        ArrayNode ring = area.putArray("coordinates").addArray();
        for (int corner : new int[] {0, 1, 3, 0}) {
            ring.addArray().add(corner & 1).add(corner >> 1);
        }
        return new DomainDetails(maybe("Nörd"), maybe(""), maybe(area), maybe(List.of("f-1", "f.2")));
    }

    private MissionPlan plan() {
        return switch (random.nextInt(3)) {
            case 0 -> new MissionPlan.FromTemplate(name(), random.nextInt(3));
            case 1 -> new MissionPlan.OfDevices(devices());
            default -> new MissionPlan.Unspecified();
        };
    }

    private MissionDevices devices() {
        List<DeviceGroup> groups = new ArrayList<>();
        for (int i = random.nextInt(4); i > 0; i--) {
            ObjectNode settings = JsonNodeFactory.instance.objectNode();
            if (random.nextBoolean()) {
                settings.putArray("path").addArray().add(1).add(2);
                settings.put("area", "north").putObject("parameters").put("mean", 18);
            }
            String carrier = groups.isEmpty() ? null : groups.get(0).label();
            groups.add(
                    random.nextInt(4) == 0
                            ? DeviceGroup.entity("urn:ngsi-ld:Robot:" + i)
                            : new DeviceGroup(
                                    "g" + i,
                                    null,
                                    "Camera",
                                    1 + random.nextInt(5),
                                    maybe(carrier),
                                    duration(),
                                    true,
                                    settings));
        }
        return new MissionDevices(groups);
    }

    private double speed() {
        return random.nextInt(3) == 0 ? ReplayCommand.MAX : 0.1 + random.nextInt(9999) / 10.0;
    }

    private Instant time() {
        return Instant.ofEpochMilli(random.nextLong(4_000_000_000_000L));
    }

    private Duration duration() {
        return Duration.ofMillis(1 + random.nextInt(10_000_000));
    }

    private String name() {
        return "n_" + random.nextInt(50) + "-x";
    }

    private <T> T maybe(T value) {
        return random.nextBoolean() ? value : null;
    }
}
