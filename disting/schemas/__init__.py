"""JSON Schemas of all JSON that disting writes, a file each, and of lines of the shipped files."""

from disting.files import Format as Format, record_schema as record_schema, schema as schema
