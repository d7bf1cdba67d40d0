package io.furrow.soak.devices;

import java.io.IOException;
import java.net.URI;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.soak.control.Http;
import io.furrow.soak.control.Until;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Checks that the programs stay connected with their logins, execute commands, and lose a login when it is rotated. */
record LoginChecks(RealFarm farm, ProgramPlan plan, Programs programs, CheckResults checkResults) {
    private static final Duration TIMEOUT = Duration.ofSeconds(90);
    private static final long MAX_CUT_DELAY_MILLIS = 2_000;

    /** The newest login of each connected program, by device. */
    Map<String, String> connected() {
        Map<String, String> users = new TreeMap<>();
        for (ProgramEvent each : programs.events()) {
            switch (each.kind()) {
                case "connected" ->
                    users.put(each.device(), each.json().path("user").asText());
                case "cut", "refused" -> users.remove(each.device());
                default -> {} // other events do not concern the connection
            }
        }
        return users;
    }

    /**
     * Waits until all programs are connected with the same logins as before; none may have been rejected since.
     *
     * @param mayBeCut whether the broker was killed, which cuts all connections
     */
    void checkUnchanged(String after, Map<String, String> before, long since, boolean mayBeCut) {
        long startedAt = System.nanoTime();
        Until.within(TIMEOUT, () -> connected().equals(before));
        double seconds = (System.nanoTime() - startedAt) / 1e9;
        List<String> differences = new ArrayList<>();
        Map<String, String> now = connected();
        before.forEach((device, user) -> {
            if (!user.equals(now.get(device))) {
                differences.add("%s is %s instead of %s".formatted(device, now.get(device), user));
            }
        });
        int cuts = 0;
        for (ProgramEvent each : programs.events()) {
            if (each.at() >= since && before.containsKey(each.device())) {
                cuts += each.is("cut") ? 1 : 0;
                if (each.is("refused") || each.is("cut") && !mayBeCut) {
                    differences.add("%s was %s".formatted(each.device(), each.kind()));
                }
            }
        }
        checkResults.add(
                "logins after " + after,
                "%d connected as before after %.1f s more, %d were disconnected, none rejected"
                        .formatted(now.size(), seconds, cuts),
                differences);
    }

    /** Sends each device a command over REST; each must answer, and the context broker must receive the answer. */
    void checkCommands(String when, List<ProgramPlan.Device> devices) throws InterruptedException {
        long since = System.currentTimeMillis();
        List<String> differences = new ArrayList<>();
        for (ProgramPlan.Device each : devices) {
            URI uri = farm.up.api("/api/devices/" + each.id() + "/commands");
            Http.Answer answer = Http.send("POST", uri, "{\"command\":\"on\"}".getBytes(UTF_8))
                    .join();
            if (answer.status() != 202) {
                differences.add("command to %s: %d %s".formatted(each.id(), answer.status(), answer.body()));
            }
        }
        double sent = (System.currentTimeMillis() - since) / 1e3;
        differences.addAll(unanswered("on", devices, since));
        checkResults.add(
                "commands, " + when,
                "%d sent in %.1f s, all answered after %.1f s"
                        .formatted(devices.size(), sent, (System.currentTimeMillis() - since) / 1e3),
                differences);
    }

    /** Sends each device a command with {@code ./furrow}. */
    void checkCommandLine(List<ProgramPlan.Device> devices) throws IOException, InterruptedException {
        long since = System.currentTimeMillis();
        for (ProgramPlan.Device each : devices) {
            farm.up.run("device", "command", each.id(), "off");
        }
        checkResults.add(
                "./furrow device command",
                "%d sent, all answered".formatted(devices.size()),
                unanswered("off", devices, since));
    }

    /** Waits for the answers. @return devices that have not answered in time */
    private List<String> unanswered(String command, List<ProgramPlan.Device> devices, long since) {
        Set<String> pending =
                new TreeSet<>(devices.stream().map(ProgramPlan.Device::id).toList());
        Until.within(TIMEOUT, () -> {
            pending.removeAll(answered(command, devices, since));
            return pending.isEmpty();
        });
        return pending.stream().map(each -> "not answered by " + each).toList();
    }

    /** Devices whose program received the command, and whose answer the context broker has. */
    private Set<String> answered(String command, List<ProgramPlan.Device> devices, long since) {
        Set<String> requested = new HashSet<>();
        programs.events().stream()
                .filter(each -> each.is("asked") && each.at() >= since)
                .filter(each -> each.json().at("/command/0").asText().equals(command))
                .forEach(each -> requested.add(each.device()));
        Set<String> types = new HashSet<>();
        devices.forEach(each -> types.add(each.id().split(":")[2]));
        Set<String> answered = new HashSet<>();
        for (String type : types) {
            for (JsonNode entity : farm.entities(type)) {
                if (entity.at("/%s_status/value".formatted(command)).asText().equals("OK")
                        && entity.at("/%s_info/value".formatted(command))
                                .asText()
                                .equals("done")) {
                    answered.add(entity.path("id").asText());
                }
            }
        }
        answered.retainAll(requested);
        return answered;
    }

    /**
     * Rotates each login, over REST and with {@code ./furrow device rotate} in turn, and gives the program its new one.
     */
    void rotate(List<ProgramPlan.Device> devices) throws IOException, InterruptedException {
        List<String> differences = new ArrayList<>();
        long max = 0;
        for (int i = 0; i < devices.size(); i++) {
            max = Math.max(max, measureRotation(devices.get(i), i % 2 == 1, differences));
        }
        checkResults.add(
                "rotated logins",
                "%d disconnected after at most %d ms, then rejected, and connected with the new login"
                        .formatted(devices.size(), max),
                differences);
    }

    /** @return ms from the request, or from the end of the command, to the end of the connection */
    private long measureRotation(ProgramPlan.Device device, boolean byCommand, List<String> differences)
            throws IOException, InterruptedException {
        String old = connected().get(device.id());
        long requested = System.currentTimeMillis();
        if (byCommand) {
            farm.up.run("device", "rotate", device.id());
        } else {
            Http.send("POST", farm.up.api("/api/devices/" + device.id() + "/credentials"), null)
                    .join();
        }
        long from = byCommand ? System.currentTimeMillis() : requested;
        boolean isCut = Until.within(TIMEOUT, () -> time("cut", device, old, requested) > 0);
        long delay = time("cut", device, old, requested) - from;
        if (!isCut || delay > MAX_CUT_DELAY_MILLIS) {
            differences.add("%s was disconnected %d ms after its login was rotated".formatted(device.id(), delay));
        }
        if (!Until.within(TIMEOUT, () -> time("refused", device, old, requested) > 0)) {
            differences.add("%s connected again with its old login, or did not try".formatted(device.id()));
        }
        programs.setCredentials(
                device.mission(),
                farm.up.run("device", "credentials", "--mission", device.mission(), "--output", "csv"));
        Until.within(TIMEOUT, () -> connected().containsKey(device.id()));
        String current = connected().get(device.id());
        if (current == null || current.equals(old)) {
            differences.add("%s does not come in with its new login".formatted(device.id()));
        }
        return delay;
    }

    /** When this first happened to a program with this login; 0 if it did not. */
    private long time(String kind, ProgramPlan.Device device, String user, long since) {
        return programs.events().stream()
                .filter(each -> each.is(kind) && each.at() >= since)
                .filter(each -> each.device().equals(device.id())
                        && each.json().path("user").asText().equals(user))
                .mapToLong(ProgramEvent::at)
                .findFirst()
                .orElse(0);
    }
}
