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
 * What Furrow's section of a password file says in comments, because it must outlive Kafka: of the devices of which topic the accounts are, and from
 * which generation on logins of a device are accepted. A login that was revoked is not accepted again by a Kafka that has lost that.
 *
 * @param topic its id; null if it is not noted
 * @param generations the latest, by device; those whose credentials were never rotated are not there
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

    static boolean isNote(String line) {
        return line.startsWith("#");
    }

    Optional<String> origin() {
        return Optional.ofNullable(topic);
    }

    SectionComments with(String newTopic) {
        return new SectionComments(newTopic, generations);
    }

    /** Notes the generations of users. */
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

    /** Why a user may not log in; empty if he may. */
    Optional<String> refusal(String user) {
        UserName name = UserName.of(user);
        int current = generations.getOrDefault(name.owner(), 0);
        return name.generation() >= current
                ? Optional.empty()
                : Optional.of(
                        ("the login '%s' was revoked before this Kafka knew of it; rotate the device's credentials %d times, and it"
                                        + " has those of generation %d again")
                                .formatted(user, current - name.generation(), current));
    }

    /** The lines of a section that has these notes. */
    List<String> before(List<String> accounts) {
        List<String> lines = new ArrayList<>();
        origin().ifPresent(id -> lines.add(TOPIC + id));
        generations.forEach((device, generation) ->
                lines.add("# Furrow: %s logs in with generation %d or later".formatted(device, generation)));
        lines.addAll(accounts);
        return lines;
    }
}
