# An apt of its own in the current folder, which installs nothing: to be sourced after `cd FOLDER`, with $suite ("bookworm"), $kind ("deb" or
# "deb-src") and, for another processor, $architecture ("i386"). Its files are in apt/; who sourced it removes that. apt checks signatures.
folder=$(pwd)
mkdir -p apt/state apt/lists/partial apt/cache/archives/partial
: >apt/status
echo "$kind [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] ${GLINT_MIRROR:-http://deb.debian.org/debian} $suite main" >apt/sources
cat >apt/conf <<END
${architecture:+APT::Architecture "$architecture";
APT::Architectures { "$architecture"; };
}APT::Sandbox::User "";
Dir::State "$folder/apt/state";
Dir::State::lists "$folder/apt/lists";
Dir::State::status "$folder/apt/status";
Dir::Cache "$folder/apt/cache";
Dir::Etc::sourcelist "$folder/apt/sources";
Dir::Etc::sourceparts "/dev/null";
END
export APT_CONFIG="$folder/apt/conf"
apt-get update -qq
