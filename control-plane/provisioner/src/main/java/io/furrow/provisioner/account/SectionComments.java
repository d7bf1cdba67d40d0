package io.furrow.provisioner.account;

import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/**
 * The comments in Furrow's section of a password file, which must outlive Kafka: the topic whose devices have the
 * accounts, and the minimum generation of each device's logins. So a revoked login stays revoked even if Kafka has lost
 * the revocation.
 *
 * @param topic its id; null if not recorded
 * @param generations latest generation by device, without devices whose credentials were never rotated
 */
record SectionComments(String topic, Map<String, Integer> generations) {
    private static final String TOPIC = "# Furrow: devices of the topic ";
    private static final Pattern GENERATION =
            Pattern.compile("# Furrow: (\\S+) logs in with generation (\\d{1,9}) or later");

    /** @param lines of the section */
    static SectionComments of(List<String> lines) {
        String topic = null;
        Map<String, Integer> generations = new TreeMap<>();
        List<String> users = new ArrayList<>();
        for (String line : lines) {
            Matcher generation = GENERATION.matcher(line);
            if (line.startsWith(TOPIC)) {
                topic = line.substring(TOPIC.length()).strip();
            } else if (generation.matches()) {
                generations.merge(generation.group(1), Integer.valueOf(generation.group(2)), Math::max);
            } else {
                users.add(MosquittoPassword.user(line));
            }
        }
        return new SectionComments(topic, generations).with(users);
    }

    static boolean isComment(String line) {
        return line.startsWith("#");
    }

    Optional<String> origin() {
        return Optional.ofNullable(topic);
    }

    SectionComments with(String newTopic) {
        return new SectionComments(newTopic, generations);
    }

    SectionComments with(Collection<String> users) {
        Map<String, Integer> next = new TreeMap<>(generations);
        for (String user : users) {
            UserName name = UserName.of(user);
            if (name.generation() > 0) {
                next.merge(name.owner(), name.generation(), Math::max);
            }
        }
        return new SectionComments(topic, next);
    }

    /** Returns the reason why a user may not log in; empty if it may. */
    Optional<String> rejection(String user) {
        UserName name = UserName.of(user);
        int current = generations.getOrDefault(name.owner(), 0);
        return name.generation() >= current
                ? Optional.empty()
                : Optional.of(
                        ("the login '%s' was revoked before this Kafka knew of it; rotate the device's credentials %d times, and it"
                                        + " has those of generation %d again")
                                .formatted(user, current - name.generation(), current));
    }

    /** Returns the lines of a section: these comments, then the accounts. */
    List<String> linesBefore(List<String> accounts) {
        List<String> lines = new ArrayList<>();
        origin().ifPresent(id -> lines.add(TOPIC + id));
        generations.forEach((device, generation) ->
                lines.add("# Furrow: %s logs in with generation %d or later".formatted(device, generation)));
        lines.addAll(accounts);
        return lines;
    }
}
