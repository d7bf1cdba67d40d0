package io.furrow.connect.source.option;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigException;

import io.furrow.connect.OptionGroup;
import io.furrow.connect.Validators;
import io.furrow.model.topic.Topics;

/** Options for the topics that the source writes. */
public record TopicOptions(AbstractConfig config) {
    static final String TOPIC = "topic";
    static final String DEAD_LETTER_TOPIC = "dead.letter.topic";

    public TopicOptions {
        if (topic(config).equals(deadLetterTopic(config))) {
            throw new ConfigException(DEAD_LETTER_TOPIC, deadLetterTopic(config), "must differ from " + TOPIC);
        }
    }

    public static void define(ConfigDef options) {
        OptionGroup group = new OptionGroup(options, "Topics");
        group.high()
                .text(TOPIC, Topics.RAW, Validators.topic(), "Topic")
                .help("Topic that every entity of a notification is written to, as normalized NGSI-v2 JSON under its"
                        + " id.");
        group.text(DEAD_LETTER_TOPIC, "", Validators.optionalTopic(), "Dead letters")
                .help("Topic for unreadable notifications and entities, with their original bytes; empty for the"
                        + " topic's name followed by .dead.");
    }

    public String topic() {
        return topic(config);
    }

    public String deadLetterTopic() {
        return deadLetterTopic(config);
    }

    private static String topic(AbstractConfig config) {
        return config.getString(TOPIC);
    }

    private static String deadLetterTopic(AbstractConfig config) {
        String topic = config.getString(DEAD_LETTER_TOPIC);
        return topic.isEmpty() ? Topics.dead(topic(config)) : topic;
    }
}
