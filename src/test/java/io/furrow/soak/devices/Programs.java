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

/** The programs of devices: processes of Python, each with up to 20 devices of a mission, which have a connection each. */
final class Programs implements AutoCloseable {
    private static final int DEVICES_OF_A_PROCESS = 20;

    private final Path program;
    private final Path folder;
    private final List<Process> processes = new ArrayList<>();
    /** How many bytes of each were read. */
    private final Map<Path, Long> logs = new LinkedHashMap<>();

    private final List<ProgramEvent> events = new ArrayList<>();

    Programs(Path program, Path folder) throws IOException {
        this.program = program;
        this.folder = Files.createDirectories(folder);
    }

    /** Brings the devices of a mission their credentials, for the first time or anew. */
    void bring(String mission, String csv) throws IOException {
        Path fresh = Files.writeString(folder.resolve(mission + ".csv.new"), csv);
        Files.move(fresh, credentials(mission), StandardCopyOption.ATOMIC_MOVE, StandardCopyOption.REPLACE_EXISTING);
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

    /** All so far, in the order of their times. */
    List<ProgramEvent> events() {
        logs.replaceAll((log, read) -> read + readOn(log, read));
        events.sort(Comparator.comparingLong(ProgramEvent::at));
        return List.copyOf(events);
    }

    /** Takes the lines that were added, without one that is just being written. @return how many bytes these are */
    private int readOn(Path log, long from) {
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
