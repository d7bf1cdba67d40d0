package io.furrow.connect;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.ConfigKey;

/** The options of a connector as a part of a page in Markdown: the groups in their order, in each its options in theirs. */
final class OptionPage {
    private OptionPage() {}

    static String of(String title, ConfigDef options) {
        Map<String, List<ConfigKey>> groups = new LinkedHashMap<>();
        options.groups().forEach(group -> groups.put(group, new ArrayList<>()));
        options.configKeys().values().stream()
                .filter(key -> !key.internalConfig)
                .forEach(key -> groups.get(key.group).add(key));
        StringBuilder page = new StringBuilder("## ").append(title).append("\n");
        groups.forEach((group, keys) -> {
            page.append("\n### ").append(group).append("\n\n| option | type | default | valid |\n|---|---|---|---|\n");
            keys.sort((a, b) -> Integer.compare(a.orderInGroup, b.orderInGroup));
            keys.forEach(key -> page.append(row(key)));
            page.append('\n');
            keys.forEach(key -> page.append("- `%s`: %s\n".formatted(key.name, key.documentation)));
        });
        return page.toString();
    }

    private static String row(ConfigKey key) {
        return "| `%s` | %s | %s | %s |%n"
                .formatted(
                        key.name,
                        key.type.name().toLowerCase(java.util.Locale.ROOT),
                        byDefault(key),
                        key.validator == null ? "" : cell(key.validator.toString()))
                .replace("\r", "");
    }

    private static String byDefault(ConfigKey key) {
        if (!key.hasDefault()) {
            return "**required**";
        }
        Object value = ConfigDef.convertToString(key.defaultValue, key.type);
        return value == null || value.toString().isEmpty() ? "none" : "`" + cell(value.toString()) + "`";
    }

    private static String cell(String text) {
        return text.replace("|", "\\|");
    }
}
