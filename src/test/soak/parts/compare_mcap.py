"""Compares MCAP files with NDJSON exports of the same missions: compare_mcap.py FILE.mcap FILE.ndjson …"""
import json
import sys
from decimal import Decimal

from mcap.reader import NonSeekingReader, SeekingReader

LAST = (2**64 - 1) // 1_000_000


def exact(text):
    return json.loads(text, parse_float=Decimal)


def expected(path):
    types = {}
    for line in open(path, encoding="utf-8"):
        event = exact(line)
        if not 0 <= event["time"] <= LAST:
            continue
        entity = event["entity"]
        service = event["headers"].get("fiware-service", "")
        entity_id = entity["id"] if entity else event["entityId"]
        last = types.get((service, entity_id), "Thing")
        types[service, entity_id] = kind = entity.get("type", "Thing") if entity else last
        data = entity or {"id": entity_id, "deleted": True}
        yield f"{kind}/{entity_id}", event["time"] * 1_000_000, service, data


def read(reader, **span):
    for schema, channel, message in reader.iter_messages(**span):
        assert schema.encoding == "jsonschema" and schema.name == channel.topic.split("/")[0], schema
        assert json.loads(schema.data)["type"] == "object"
        assert channel.message_encoding == "json" and message.publish_time == message.log_time
        yield channel.topic, message.log_time, channel.metadata["fiware-service"], exact(message.data)


def order(message):
    return message[1], message[2], message[0], json.dumps(message[3], default=str)


def compare(mcap, lines):
    messages = sorted(expected(lines), key=order)
    with open(mcap, "rb") as file:
        sequential = sorted(read(NonSeekingReader(file, validate_crcs=True)), key=order)
    assert sequential == messages, f"{mcap}: read from start to end"
    with open(mcap, "rb") as file:
        reader = SeekingReader(file, validate_crcs=True)
        summary = reader.get_summary()
        assert summary.statistics.message_count == len(messages)
        assert sum(summary.statistics.channel_message_counts.values()) == len(messages)
        assert sorted(read(reader), key=order) == messages, f"{mcap}: read by its index"
        if messages:
            middle = messages[len(messages) // 2][1]
            late = [message for message in messages if message[1] >= middle]
            assert sorted(read(reader, starting_at=middle), key=order) == late, f"{mcap}: from the middle"
            topic = messages[0][0]
            of_topic = [message for message in messages if message[0] == topic]
            assert sorted(read(reader, topics=[topic]), key=order) == of_topic, f"{mcap}: one topic"
    print(f"{mcap}: {len(messages)} events, {len(summary.channels)} channels, {len(summary.chunk_indexes)} chunks")


for i in range(1, len(sys.argv), 2):
    compare(sys.argv[i], sys.argv[i + 1])
