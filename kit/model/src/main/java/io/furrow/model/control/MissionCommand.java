package io.furrow.model.control;

import java.time.Duration;
import java.time.Instant;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.annotation.JsonTypeName;
import com.fasterxml.jackson.annotation.JsonUnwrapped;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** A command on the topic {@code service.missionmanager}. */
public sealed interface MissionCommand extends Command {
    @JsonTypeName("create")
    record Create(String mission, String domain, MissionPlan plan) implements MissionCommand {
        @Override
        public void describe(ObjectNode request) {
            request.put("mission", mission).put("domain", domain);
            plan.describe(request);
        }
    }

    /**
     * Starts a mission and creates it if it does not exist.
     *
     * @param domain null for that of an existing mission
     * @param start null or a time in the past to start at once
     * @param duration from the start until the mission is stopped; null for unlimited
     */
    @JsonTypeName("start")
    record Start(String mission, String domain, MissionPlan plan, Instant start, Duration duration)
            implements MissionCommand {
        @Override
        public void describe(ObjectNode request) {
            request.put("mission", mission);
            DeviceGroup.put(request, "domain", domain);
            plan.describe(request);
            DeviceGroup.put(request, "start", start);
            DeviceGroup.put(request, "duration", duration == null ? null : duration.toString());
        }
    }

    @JsonTypeName("stop")
    record Stop(String mission) implements MissionCommand {}

    @JsonTypeName("delete")
    record Delete(String mission) implements MissionCommand {}

    /** Adds devices to an inactive mission. */
    @JsonTypeName("add-devices")
    record AddDevices(String mission, MissionDevices devices) implements MissionCommand {}

    /** Stores a new version of a template; the version in the request is ignored. */
    @JsonTypeName("save-template")
    record SaveTemplate(@JsonUnwrapped MissionTemplate template) implements MissionCommand {}

    /** @param version 0 for all */
    @JsonTypeName("delete-template")
    record DeleteTemplate(
            String template,
            @JsonInclude(JsonInclude.Include.NON_DEFAULT) int version) implements MissionCommand {}

    /**
     * Gives a device a new password and rejects the old one from then on.
     *
     * @param device id of its entity
     */
    @JsonTypeName("rotate-credentials")
    record RotateCredentials(String device) implements MissionCommand {}

    /** Returns the mission that it changes; null if it changes something else. */
    default String mission() {
        return null;
    }

    static MissionCommand read(String verb, JsonObjectReader members) throws RejectedException {
        return switch (verb == null ? "" : verb) {
            case "create" -> new Create(members.name("mission"), members.name("domain"), MissionPlan.read(members));
            case "start" ->
                new Start(
                        members.name("mission"),
                        members.nameOrNull("domain"),
                        MissionPlan.read(members),
                        members.timeOrNull("start"),
                        members.durationOrNull("duration"));
            case "stop" -> new Stop(members.name("mission"));
            case "delete" -> new Delete(members.name("mission"));
            case "add-devices" -> new AddDevices(members.name("mission"), readAdded(members));
            case "save-template" -> {
                MissionTemplate template = MissionTemplate.read(members);
                template.devices().withValidAreas();
                yield new SaveTemplate(template);
            }
            case "delete-template" ->
                new DeleteTemplate(members.name("template"), members.wholeNumber("version", 1, Integer.MAX_VALUE, 0));
            case "rotate-credentials" -> new RotateCredentials(members.text("device"));
            default ->
                throw Requests.unknown(
                        verb,
                        "create, start, stop, delete, add-devices, save-template, delete-template, rotate-credentials");
        };
    }

    private static MissionDevices readAdded(JsonObjectReader members) throws RejectedException {
        if (!members.has("devices")) {
            throw new RejectedException(ErrorCode.MISSING_MEMBER, "the request needs a member 'devices'");
        }
        return MissionDevices.readPart(members).withValidAreas();
    }
}
