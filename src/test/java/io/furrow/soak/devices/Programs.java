package io.furrow.soak.devices;

import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import static java.nio.charset.StandardCharsets.US_ASCII;

/**
 * Runs the programs of devices as Python processes, each with up to 20 devices of a mission, which have a connection
 * each.
 */
final class Programs implements AutoCloseable {
    private static final int DEVICES_OF_A_PROCESS = 20;

    private final Path program;
    private final Path folder;
    private final List<Process> processes = new ArrayList<>();
    /** The number of bytes read from each log. */
    private final Map<Path, Long> logs = new LinkedHashMap<>();

    private final List<ProgramEvent> events = new ArrayList<>();

    Programs(Path program, Path folder) throws IOException {
        this.program = program;
        this.folder = Files.createDirectories(folder);
    }

    /** Writes the credentials of a mission's devices, which running programs reload. */
    void setCredentials(String mission, String csv) throws IOException {
        Path temporary = Files.writeString(folder.resolve(mission + ".csv.new"), csv);
        Files.move(
                temporary, credentials(mission), StandardCopyOption.ATOMIC_MOVE, StandardCopyOption.REPLACE_EXISTING);
    }

    private Path credentials(String mission) {
        return folder.resolve(mission + ".csv");
    }

    void start(ProgramPlan.Mission mission) throws IOException {
        List<ProgramPlan.Device> devices = mission.devices();
        for (int first = 0; first < devices.size(); first += DEVICES_OF_A_PROCESS) {
            String name = mission.name() + "-" + first;
            Path behavior = folder.resolve(name + ".json");
            Files.write(
                    behavior,
                    devices.subList(first, Math.min(devices.size(), first + DEVICES_OF_A_PROCESS)).stream()
                            .map(device -> device.behavior().toString())
                            .toList());
            Path log = folder.resolve(name + ".events");
            logs.put(Files.createFile(log), 0L);
            processes.add(new ProcessBuilder(
                            "python3",
                            program.toString(),
                            credentials(mission.name()).toString(),
                            behavior.toString(),
                            log.toString())
                    .redirectErrorStream(true)
                    .redirectOutput(folder.resolve(name + ".out").toFile())
                    .start());
        }
    }

    int processes() {
        return processes.size();
    }

    boolean areAlive() {
        return processes.stream().allMatch(Process::isAlive);
    }

    /** All events so far, sorted by time. */
    List<ProgramEvent> events() {
        logs.replaceAll((log, read) -> read + readNewLines(log, read));
        events.sort(Comparator.comparingLong(ProgramEvent::at));
        return List.copyOf(events);
    }

    /** Reads complete new lines. @return their number of bytes */
    private int readNewLines(Path log, long from) {
        try (InputStream in = Files.newInputStream(log)) {
            in.skipNBytes(from);
            String text = new String(in.readAllBytes(), US_ASCII);
            String lines = text.substring(0, text.lastIndexOf('\n') + 1);
            lines.lines().map(ProgramEvent::read).forEach(events::add);
            return lines.length();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    @Override
    public void close() {
        processes.forEach(Process::destroyForcibly);
    }
}
